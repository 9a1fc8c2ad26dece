/// @file
/// Scene → mesh → modes and residual flexibility: the finite-element half of a run.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "fem/modal_analysis.hpp"
#include "mesh/mesh.hpp"
#include "pipelines/scene/scene_description.hpp"

namespace microslip::pipelines {

/// The mesh of a scene: the parametric blade or a STEP file is meshed into `mesh_file`, a given mesh is read; it knows the points
/// of the scene by name.
/// @throws mesh::MeshError, std::invalid_argument  see mesh_blade, mesh_step_model and read_mesh.
/// @throws SceneError  see name_points().
[[nodiscard]] mesh::Mesh obtain_mesh(const SceneDescription& scene,
                                     const std::filesystem::path& mesh_file);

/// The same where it stands in a file: `mesh_file` if the scene's own is meshed, else the scene's.
[[nodiscard]] mesh::Mesh reread_mesh(const SceneDescription& scene,
                                     const std::filesystem::path& mesh_file);

/// "12345 nodes, 6789 elements, volume … m³, mass … kg, bounding box …" and the names of the surfaces.
[[nodiscard]] std::string describe_mesh(const mesh::Mesh& mesh, double density);

struct StructureModes {
  Eigen::Index n_dofs = 0;  ///< free degrees of freedom
  double mass = 0.0;        ///< [kg]
  fem::ModalBasis basis;
  std::vector<fem::ResidualFlexibility>
      residuals;  ///< of the contact surfaces, one each; empty: none
  /// How the attachment shapes of `basis` were chosen, "" without them.
  std::string attachment_text;
  std::vector<std::string> notes, warnings;  ///< about modes of another code, or rotation
  fem::ModalTimings timings;
  std::optional<fem::RicherBasis> richer;  ///< with attachment shapes of one degree more
};

/// Checks all names of the scene against the mesh before anything is solved.
/// @throws mesh::MeshError, SceneError  a surface or point that is not there, a face that is not plane.
void check_names(const mesh::Mesh& mesh, const SceneDescription& scene);

/// Assembles and solves, of a structure that rotates about its static equilibrium; modes of another code are read
/// instead (given_modes.hpp). Collective over the MPI ranks. The residual flexibility of a structure that
/// floats is that of inertia relief.
[[nodiscard]] StructureModes solve_structure(const mesh::Mesh& mesh, const SceneDescription& scene);

}  // namespace microslip::pipelines
