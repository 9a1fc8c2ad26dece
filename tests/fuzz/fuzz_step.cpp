// Units and statements of STEP files.
#include "mesh/mesh_error.hpp"
#include "mesh/step_geometry.hpp"
#include "tests/fuzz/fuzz.hpp"
#include "tests/support/file_in_memory.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace microslip;
  return tests::read_or_refused<mesh::MeshError>(data, size, [](std::string_view text) {
    static_cast<void>(mesh::step_length_units(test::FileInMemory(text).path()));
  });
}
