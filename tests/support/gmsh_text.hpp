/// @file
/// Content of a .msh file → Mesh, by way of a file in memory.
#pragma once

#include <string>
#include <string_view>

#include "mesh/mesh_reader.hpp"
#include "tests/support/file_in_memory.hpp"

namespace microslip::test {

/// @param name  what messages call it.
inline mesh::Mesh read_gmsh_text(std::string_view content, const std::string& name,
                                 double length_unit = 1.0) {
  return mesh::read_gmsh(FileInMemory(content).path(), length_unit, name);
}

}  // namespace microslip::test
