/// @file
/// What effects of contact that are left out would change, each had alone: the peaks are solved for
/// again with it. A proof that leaving them out was right, or a measure of how wrong it is.
#pragma once

#include <vector>

#include "pipelines/description/scene_description.hpp"
#include "pipelines/model/reduced_model.hpp"
#include "pipelines/response/error_row.hpp"
#include "pipelines/response/run_results.hpp"

namespace microslip::pipelines {

/// Of normal motion, and of friction along r where a scene forbids it though the patch moves along
/// r; harmonics and friction along r that was left to the program are in the error budget. They are
/// physics, not discretisation: no bar has them.
/// @param result  a curve of the model, solved by harmonic balance, with a peak;
///                else there are none.
/// @return rows of both goals, `source` the name of the effect: the largest change of all peaks of
///         the curve, of amplitude over the highest one, a lower peak that is not found changing by
///         all it has; infinite: the highest peak with the effect is not found from that of the
///         curve.
[[nodiscard]] std::vector<ErrorRow> rows_left_out(const ReducedModel& model,
                                                  const SceneDescription& scene,
                                                  const CurveResult& result);

}  // namespace microslip::pipelines
