#include "pipelines/structure/solved_structure.hpp"

#include <utility>

#include "pipelines/structure/extrapolated_modes.hpp"
#include "pipelines/structure/larger_elements.hpp"

namespace microslip::pipelines {

SolvedStructure solved_structure(const SceneDescription& scene,
                                 const std::filesystem::path& mesh_file, int cores) {
  mesh::Mesh mesh = obtain_mesh(scene, mesh_file);
  check_names(mesh, scene);
  return solved_on(std::move(mesh), scene, cores);
}

SolvedStructure solved_on(mesh::Mesh mesh, const SceneDescription& scene, int cores) {
  LargerElements larger(scene, mesh, cores);
  StructureModes modes = solve_structure(mesh, scene);
  SolvedStructure structure{std::move(mesh), std::move(modes)};
  // What was done is told of the first.
  static_cast<void>(extrapolate_modes(structure, scene, larger));
  return structure;
}

}  // namespace microslip::pipelines
