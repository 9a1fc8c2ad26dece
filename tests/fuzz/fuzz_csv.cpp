// Tables of numbers.
#include "pipelines/system/scene_error.hpp"
#include "pipelines/text/csv_table.hpp"
#include "tests/fuzz/fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace microslip;
  return tests::read_or_refused<pipelines::SceneError>(data, size, [](std::string_view text) {
    static_cast<void>(pipelines::CsvTable::parse(text, "table.csv"));
  });
}
