#include "pipelines/studies/mesh_study.hpp"

#include <iostream>

#include "mesh/element_shape.hpp"

#include "pipelines/model/scene_places.hpp"
#include "pipelines/structure/structure_stage.hpp"
#include "pipelines/system/exit_code.hpp"
#include "pipelines/system/interrupt.hpp"
#include "pipelines/system/result_cache.hpp"
#include "pipelines/system/scene_error.hpp"

namespace microslip::pipelines {

int mesh_study(const SceneDescription& scene, const RunOptions& options) {
  const ResultCache cache(options.cache, [&](const std::string& line) {
    if (options.verbosity != Verbosity::quiet) std::cout << line << '\n';
  });
  const mesh::Mesh mesh = obtain_mesh(scene, options.output);
  if (interrupt_requested()) throw InterruptedError("interrupted after the mesh was written");
  check_names(mesh, scene);
  if (options.verbosity != Verbosity::quiet) {
    std::cout << describe_mesh(mesh, scene.material.density) << '\n';
  }
  for (const std::string& warning : mesh::shape_warnings(mesh))
    std::cerr << "warning: " << warning << '\n';
  if (options.verbosity != Verbosity::quiet)
    std::cout << "written: " << options.output.string() << '\n';
  return static_cast<int>(ExitCode::complete);
}

}  // namespace microslip::pipelines
