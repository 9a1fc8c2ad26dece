/// @file
/// How much a patch moves along r, from the two linear limits:
/// whether a scene calls for friction there.
#pragma once

#include "pipelines/description/scene_description.hpp"
#include "pipelines/model/reduced_model.hpp"

namespace microslip::pipelines {

/// Friction along r does ½ ratio² of the work of that along p: 0.05 % at the threshold of 3 %, as
/// much as harmonics are left out for. Simulated on the default blade (1.5 %),
/// it changes the peak by 0.013 %.
///
/// Motion of the patch along r against that along p, rms over its area: the largest ratio at the
/// resonances of the free and of the stuck structure in the frequency range, and where either limit
/// moves the patch most. 0 where nothing moves or nothing rubs.
/// @param model  with its patches.
[[nodiscard]] double motion_ratio_along_r(const ReducedModel& model, const SceneDescription& scene);

/// Whether any place that rubs can move along r at all: with slip it may, though the linear limits
/// do not.
/// @param model  with its patches.
[[nodiscard]] bool can_rub_along_r(const ReducedModel& model);

}  // namespace microslip::pipelines
