// Meshes of gmsh, 2.2 and 4.1, text and binary.
#include <string>

#include "mesh/mesh_error.hpp"
#include "tests/fuzz/fuzz.hpp"
#include "tests/support/gmsh_text.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace microslip;
  return tests::read_or_refused<mesh::MeshError>(data, size, [](std::string_view text) {
    static_cast<void>(test::read_gmsh_text(text, "mesh.msh"));
  });
}
