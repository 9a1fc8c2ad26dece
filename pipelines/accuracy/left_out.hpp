/// @file
/// What effects that are left out would change, each had alone: the peaks are solved for again with
/// it. A proof that leaving them out was right, or a measure of how wrong it is.
#pragma once

#include <vector>

#include "pipelines/accuracy/richer_models.hpp"
#include "pipelines/description/scene_description.hpp"
#include "pipelines/effects/model_family.hpp"
#include "pipelines/model/reduced_model.hpp"
#include "pipelines/response/error_row.hpp"
#include "pipelines/response/run_results.hpp"

namespace microslip::pipelines {

/// The model at hand with one effect more each: normal motion that is left out, friction along r
/// where a scene forbids it though the patch moves along r, and what is "off" though other keys
/// give it: roughness (not without normal motion), dependence on speed, moments, the shape of a
/// static preload; residual and rotation, for which modes are solved for again.
/// Harmonics and friction along r that was left to the program are in the error budget.
/// @param structure  of the scene; nullptr: a kind that gives its modes itself.
/// @return `source` is the name of the effect; `unknown` and `note` tell of those that cannot be
///         had.
[[nodiscard]] RicherModels models_left_out(const ReducedModel& model, const SceneDescription& scene,
                                           const SolvedStructure* structure);

/// They are physics, not discretisation: no bar has them.
/// @param others  models_left_out().
/// @param result  a curve of the model, solved by harmonic balance, with a peak;
///                else there are none.
/// @return rows of both goals, `source` the name of the effect: the largest change of all peaks of
///         the curve, of amplitude over the highest one, a lower peak that is not found changing by
///         all it has; infinite: the highest peak with the effect is not found from that of the
///         curve, or the load is refused with it.
[[nodiscard]] std::vector<ErrorRow> rows_left_out(const ReducedModel& model,
                                                  const SceneDescription& scene,
                                                  const std::vector<RicherModel>& others,
                                                  const CurveResult& result);

}  // namespace microslip::pipelines
