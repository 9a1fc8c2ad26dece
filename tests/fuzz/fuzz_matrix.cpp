// Sparse matrices in Matrix Market format.
#include "pipelines/scene/matrix_files.hpp"
#include "pipelines/system/scene_error.hpp"
#include "tests/fuzz/fuzz.hpp"
#include "tests/support/file_in_memory.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace microslip;
  return tests::read_or_refused<pipelines::SceneError>(data, size, [](std::string_view text) {
    static_cast<void>(pipelines::read_matrix_market(test::FileInMemory(text).path()));
  });
}
