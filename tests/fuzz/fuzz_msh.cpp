// Meshes of gmsh, 2.2 and 4.1, text and binary.
#include <string>

#include "mesh/mesh_error.hpp"
#include "mesh/mesh_reader.hpp"
#include "tests/fuzz/fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace microslip;
  return tests::read_or_refused<mesh::MeshError>(data, size, [](std::string_view text) {
    static_cast<void>(mesh::read_gmsh_text(std::string(text), "mesh.msh", 1.0));
  });
}
