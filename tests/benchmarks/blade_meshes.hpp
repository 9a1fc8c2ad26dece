/// @file
/// Meshes of the default blade for benchmarks. The mesher is a child process: make them before
/// PETSc is opened.
#pragma once

#include "mesh/mesh.hpp"
#include "mesh/mesh_reader.hpp"
#include "mesh/mesher_process.hpp"
#include "tests/support/temporary_folder.hpp"

namespace microslip::test {

[[nodiscard]] inline mesh::Mesh default_blade_mesh(double element_size) {
  const TemporaryFolder folder;
  mesh::mesh_blade({}, {element_size}, folder.path() / "blade.msh");
  return mesh::read_gmsh(folder.path() / "blade.msh");
}

}  // namespace microslip::test
