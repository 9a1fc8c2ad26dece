/// @file
/// Which physical effects a scene is simulated with, and why: one row per effect.
#pragma once

#include <vector>

#include "pipelines/run_results.hpp"
#include "pipelines/scene_description.hpp"
#include "pipelines/write_summary.hpp"

namespace microslip::pipelines {

/// @param model  with its effects decided; nullptr: not known yet, `auto` says so.
[[nodiscard]] std::vector<EffectRecord> effects_of(const SceneDescription& scene,
                                                   const ReducedModel* model);

/// Sentences on settings that are possible but seldom meant.
[[nodiscard]] std::vector<std::string> scene_warnings(const SceneDescription& scene);

/// Tells with the results what harmonics = "auto" has chosen; nothing to tell where they were given.
void tell_harmonics(const SceneDescription& scene, const std::vector<CurveSummary>& curves,
                    std::vector<EffectRecord>& effects);

}  // namespace microslip::pipelines
