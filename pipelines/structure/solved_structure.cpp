#include "pipelines/structure/solved_structure.hpp"

#include <utility>

#include "pipelines/structure/extrapolated_modes.hpp"

namespace microslip::pipelines {

SolvedStructure solved_structure(const SceneDescription& scene,
                                 const std::filesystem::path& mesh_file) {
  mesh::Mesh mesh = obtain_mesh(scene, mesh_file);
  check_names(mesh, scene);
  return solved_on(std::move(mesh), scene);
}

SolvedStructure solved_on(mesh::Mesh mesh, const SceneDescription& scene) {
  StructureModes modes = solve_structure(mesh, scene);
  SolvedStructure structure{std::move(mesh), std::move(modes)};
  static_cast<void>(extrapolate_modes(structure, scene));  // what was done is told of the first
  return structure;
}

}  // namespace microslip::pipelines
