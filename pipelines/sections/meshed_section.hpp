/// @file
/// Sections that only scenes with a mesh have: the blade or the mesh file, material, supports,
/// modes, forces.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "pipelines/description/scene_description.hpp"
#include "pipelines/text/section_reader.hpp"

namespace microslip::pipelines {

/// All throw SceneError with file, line and key.
[[nodiscard]] BladeModel read_blade(const SectionReader& s);
/// Without its faces. @param folder  what relative paths are relative to.
[[nodiscard]] StepModel read_step_file(SectionReader s, const std::filesystem::path& folder);
[[nodiscard]] MeshFileModel read_mesh_file(SectionReader s, const std::filesystem::path& folder);
/// Modes of another code and their mesh. @param has_density  to rescale shapes by.
[[nodiscard]] MeshFileModel read_modes_file(SectionReader s, const std::filesystem::path& folder,
                                            bool has_density);
[[nodiscard]] fem::Material read_material(const SectionReader& s);
[[nodiscard]] std::vector<std::string> read_names(const SectionReader& s, std::string_view key);
[[nodiscard]] BasisSettings read_basis(const SectionReader& s);
/// Of given modes; n_modes = 0: all there are.
[[nodiscard]] BasisSettings read_given_basis(const SectionReader& s);
[[nodiscard]] ModesDescription read_modes(const SectionReader& s, int n_modes);
/// Attachment shapes need a local stiffness to stand behind: a rigid contact takes the residual
/// stiffness instead where the scene does not say. @param s  [modes].
/// @return  that it did so, or nothing.
/// @throws SceneError  it says attachment.
[[nodiscard]] std::string settle_residual(SectionReader& s, BasisSettings& basis,
                                          const ContactDescription& contact);
/// @param spec    keys of a force: "force", or "static.force", which has no phase.
/// @param points  of the scene; coordinates of a force join them.
[[nodiscard]] std::vector<ForceDescription> read_forces(SectionReader& s, std::string_view spec,
                                                        std::vector<PointDescription>& points);

}  // namespace microslip::pipelines
