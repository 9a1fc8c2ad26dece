/// @file
/// What is drawn after the curves: how long that is expected to take.
#pragma once

#include "pipelines/description/scene_description.hpp"

namespace microslip::pipelines {

/// Seconds of one core of this machine.
struct PictureSeconds {
  double maps = 0.0;
  double plots = 0.0;
};
/// None without [response]; linear limits have no maps.
[[nodiscard]] PictureSeconds picture_seconds(const SceneDescription& scene);

}  // namespace microslip::pipelines
