/// @file
/// Which physical effects a scene is simulated with, and why: one row per effect.
#pragma once

#include <string>
#include <vector>

#include "pipelines/model/effect_record.hpp"
#include "pipelines/model/reduced_model.hpp"
#include "pipelines/scene/scene_description.hpp"

namespace microslip::pipelines {

/// @param model  with its effects decided; nullptr: not known yet, `auto` says so.
[[nodiscard]] std::vector<EffectRecord> effects_of(const SceneDescription& scene,
                                                   const ReducedModel* model);

/// What a scene says of its harmonics, in words.
[[nodiscard]] std::string harmonics_text(const SceneDescription& scene);

/// Sentences on settings that are possible but seldom meant.
[[nodiscard]] std::vector<std::string> scene_warnings(const SceneDescription& scene);

}  // namespace microslip::pipelines
