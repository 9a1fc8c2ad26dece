/// @file
/// A picture of the blade with what the scene uses of it.
#pragma once

#include <filesystem>
#include <string>

#include "mesh/mesh.hpp"
#include "pipelines/description/scene_description.hpp"

namespace microslip::pipelines {

/// Skin of the mesh, clamped and contact faces, axes of the contacts, forces and output with their
/// names (share/scripts/plot_scene.py).
/// @param picture  .png, .svg or .pdf; its folder must exist.
/// @return  empty, or why there is no picture.
[[nodiscard]] std::string draw_scene(const mesh::Mesh& mesh, const SceneDescription& scene,
                                     const std::filesystem::path& picture);

}  // namespace microslip::pipelines
