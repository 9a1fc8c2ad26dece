/// @file
/// Which physical effects a scene is simulated with, and why: one row per effect.
#pragma once

#include <vector>

#include "pipelines/scene_description.hpp"
#include "pipelines/write_summary.hpp"

namespace microslip::pipelines {

[[nodiscard]] std::vector<EffectRecord> effects_of(const SceneDescription& scene);

}  // namespace microslip::pipelines
