/// @file
/// What effects that are left out would change: the peaks are solved for again with each of them. A
/// proof that leaving them out was right, or a measure of how wrong it is.
#pragma once

#include <vector>

#include "pipelines/accuracy/models_left_out.hpp"
#include "pipelines/description/scene_description.hpp"
#include "pipelines/model/reduced_model.hpp"
#include "pipelines/response/error_row.hpp"
#include "pipelines/response/run_results.hpp"

namespace microslip::pipelines {

/// They are physics, not discretisation: no bar has them.
///
/// Of a curve by harmonic balance the rows tell amplitude and frequency of its peaks; of a motion
/// integrated in time those of the largest, integrated again, or where that takes too long the
/// amplitude at its frequency alone; of a linear limit, where limits are all that is asked for, its
/// highest peak.
/// A curve without a peak within its range has rows of the resonance and of its end in their place,
/// and a peak that leaves the range one of its frequency.
/// @param others  models_left_out().
/// @param result  a curve of the model.
/// @return rows of these goals, `source` the name of the effect: the largest change of all peaks of
///         the curve (of several effects together of the highest alone), of amplitude over the
///         highest one, a lower peak that is not found changing by what the whole curve with
///         the effect, or the amplitude at its frequency, tells, else by all it has; infinite: the
///         highest peak with the effect is not found from that of the curve, nor along a curve of
///         its own (which is traced where that takes less than a minute), or the load is refused
///         with it.
[[nodiscard]] std::vector<ErrorRow> rows_left_out(const ReducedModel& model,
                                                  const SceneDescription& scene,
                                                  const std::vector<RicherModel>& others,
                                                  const CurveResult& result);

}  // namespace microslip::pipelines
