/// @file
/// What the mesh of a scene follows from, where it is meshed here.
#pragma once

#include <string>

#include "pipelines/description/scene_description.hpp"

namespace microslip::pipelines {

/// Geometry, sizes and names, and the mesher itself: two scenes with the same bytes have the same
/// mesh.
/// @param scene  of kind "blade" or "step".
[[nodiscard]] std::string geometry_of(const SceneDescription& scene);

}  // namespace microslip::pipelines
