/// @file
/// Sentences on settings of a scene that are possible but seldom meant.
#pragma once

#include <string>
#include <vector>

#include "pipelines/description/scene_description.hpp"

namespace microslip::pipelines {

[[nodiscard]] std::vector<std::string> scene_warnings(const SceneDescription& scene);

}  // namespace microslip::pipelines
