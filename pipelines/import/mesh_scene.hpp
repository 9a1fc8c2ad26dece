/// @file
/// `init mesh FILE`, `init modes FILE`: a scene that begins with the names,
/// the size and the unit of a mesh.
#pragma once

#include <filesystem>
#include <string>

namespace microslip::pipelines {

/// The template of kind "mesh", with names of the file where the template has examples: those whose
/// words tell what they are for ("root", "fixed", "contact", "output" …), else the first that can
/// be; the others in comments.
/// @param folder  of the scene: the file is named relative to it.
/// @throws as read_mesh().
/// @note read_scene takes it as it is; what nobody can know (frequencies, stiffness,
///       forces) is to be edited.
[[nodiscard]] std::string scene_of_mesh(const std::filesystem::path& file,
                                        const std::filesystem::path& folder);

/// The same of kind "modes". Of a stiffness (.mtx) with mass.mtx and nodes.csv beside it.
/// @param mesh  of the modes; "": the deck of their name beside them, else of the meshes there (of
///              a stiffness also in the folder above) the only one, or that of their name.
/// @throws SceneError  no such file, or none of a mesh beside it.
[[nodiscard]] std::string scene_of_modes(const std::filesystem::path& file,
                                         const std::filesystem::path& mesh,
                                         const std::filesystem::path& folder);

}  // namespace microslip::pipelines
