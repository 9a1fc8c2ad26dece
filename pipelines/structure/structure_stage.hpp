/// @file
/// Scene → mesh → modes and residual flexibility: the finite-element half of a run.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "mesh/mesh.hpp"
#include "pipelines/description/scene_description.hpp"
#include "pipelines/structure/structure_task.hpp"

namespace microslip::pipelines {

/// The mesh of a scene: the parametric blade or a STEP file is meshed into `mesh_file`, or the mesh
/// an earlier run has made of the same is put there; a given mesh is read, and its elements are
/// made quadratic and cut as the scene says.
/// It knows the points of the scene by name.
/// @throws mesh::MeshError, std::invalid_argument  see mesh_blade, mesh_step_model and read_mesh.
/// @throws SceneError  see name_points(). fem::MemoryError  see require_memory_when_cut().
[[nodiscard]] mesh::Mesh obtain_mesh(const SceneDescription& scene,
                                     const std::filesystem::path& mesh_file);

/// The same where it stands in a file: `mesh_file` if the scene's own is meshed, else the scene's.
[[nodiscard]] mesh::Mesh reread_mesh(const SceneDescription& scene,
                                     const std::filesystem::path& mesh_file);

/// "12345 nodes, 6789 elements, volume … m³, mass … kg,
/// bounding box …" and the names of the surfaces.
[[nodiscard]] std::string describe_mesh(const mesh::Mesh& mesh, double density);

/// Checks all names of the scene against the mesh before anything is solved.
/// @throws mesh::MeshError, SceneError  a surface or point that is not there, axes that a face does
///         not have (require_frames).
void check_names(const mesh::Mesh& mesh, const SceneDescription& scene);

/// Assembles and solves, of a structure that rotates about its static equilibrium; modes of another
/// code are read instead (given_modes.hpp). What an earlier run has solved is taken from there
/// (system/result_cache.hpp). The residual flexibility of a structure that floats is that of
/// inertia relief.
[[nodiscard]] StructureModes solve_structure(const mesh::Mesh& mesh, const SceneDescription& scene);

/// How the same task is solved elsewhere, with the arithmetic there.
struct SolvedElsewhere {
  std::string arithmetic;
  std::function<StructureModes(const StructureTask&)> solve;
};

/// The same solution bit for bit needs the same arithmetic: BLAS and its threads, ranks, libraries.
/// @return that of this process, now.
[[nodiscard]] std::string arithmetic();

/// From any thread, elsewhere, of a scene without given modes or matrices and static preload.
[[nodiscard]] StructureModes solve_structure(const mesh::Mesh& mesh, const SceneDescription& scene,
                                             const SolvedElsewhere& elsewhere);

/// The same where an earlier run has kept it: nothing is solved but the statics of a static
/// preload. Empty: it has not.
[[nodiscard]] std::optional<StructureModes> kept_structure(const mesh::Mesh& mesh,
                                                           const SceneDescription& scene);

}  // namespace microslip::pipelines
