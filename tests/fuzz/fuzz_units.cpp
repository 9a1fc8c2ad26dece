// Numbers with units, where one of several dimensions is asked for.
#include "pipelines/text/units.hpp"
#include "tests/fuzz/fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace microslip;
  return tests::read_or_refused<pipelines::UnitError>(data, size, [](std::string_view text) {
    for (const char* unit : {"Pa", "m", "1", "rad/s", "N/m^3"}) {
      static_cast<void>(pipelines::to_si(text, unit));
    }
  });
}
