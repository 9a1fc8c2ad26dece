// Formulas over a patch.
#include <string>

#include "pipelines/system/scene_error.hpp"
#include "pipelines/text/expression.hpp"
#include "tests/fuzz/fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace microslip;
  return tests::read_or_refused<pipelines::SceneError>(data, size, [](std::string_view text) {
    const pipelines::Expression expression(std::string(text), "scene.toml:1: key", {{"L", 1.0}});
    static_cast<void>(
        expression.at(Eigen::Vector3d(-1.0, 0.0, 2.0), Eigen::Vector3d(0.5, 0.0, -1.0)));
  });
}
