/// @file
/// The harmonics that curves have used, told in the table of effects.
#pragma once

#include <vector>

#include "pipelines/model/effect_record.hpp"
#include "pipelines/response/run_summary.hpp"
#include "pipelines/scene/scene_description.hpp"

namespace microslip::pipelines {

/// Tells with the results what harmonics = "auto" has chosen; nothing to tell where they were given.
void tell_harmonics(const SceneDescription& scene, const std::vector<CurveSummary>& curves,
                    std::vector<EffectRecord>& effects);

}  // namespace microslip::pipelines
