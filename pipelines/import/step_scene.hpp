/// @file
/// `init step FILE`: a scene that begins with the faces, the size and the unit of a STEP file;
/// and the list of faces.
#pragma once

#include <filesystem>
#include <string>

#include "pipelines/import/step_mesh.hpp"

namespace microslip::pipelines {

/// A line for each face: number, kind, area, centre, normal; the unit and the size above.
[[nodiscard]] std::string describe_faces(const StepBody& body);

/// The template of kind "step" with what the file has: an element size of a blade's, two plane
/// faces that may be held and rub, and the corner farthest from what is held for force and output.
/// What nobody can know is to be edited.
/// @param folder  of the scene: the file is named relative to it.
/// @throws as open_step().
/// @note read_scene takes it as it is.
[[nodiscard]] std::string scene_of_step(const std::filesystem::path& file,
                                        const std::filesystem::path& folder);

}  // namespace microslip::pipelines
