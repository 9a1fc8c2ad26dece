/// @file
/// The curves a scene asks for.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "pipelines/scene/scene_description.hpp"

namespace microslip::pipelines {

/// What one curve is asked for: a preload, a scale of the preload (modal scenes and bars), or a linear
/// limit.
struct CurveRequest {
  std::string name;      ///< stem of the CSV
  PreloadEntry preload;  ///< [N], or the scale
};

/// Curves of a scene in the order they are written: the asked ones, then the limits of a modal scene.
[[nodiscard]] std::vector<CurveRequest> curve_requests(const SceneDescription& scene);

}  // namespace microslip::pipelines
