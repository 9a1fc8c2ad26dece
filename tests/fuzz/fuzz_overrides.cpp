// What stands behind --set: a path into a scene, and a value of TOML or a text.
#include "pipelines/scene/scene_overrides.hpp"

#include <string>

#include "pipelines/system/scene_error.hpp"
#include "pipelines/text/toml_text.hpp"
#include "tests/fuzz/fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace microslip;
  return tests::read_or_refused<pipelines::SceneError>(data, size, [](std::string_view text) {
    toml::table scene = pipelines::parse_toml(
        "[model]\nkind = \"mesh\"\n[response]\npreload = [1, 2]\noptimum = \"preload\"\n"
        "[excitation]\nforces = [ { at = \"B\", amplitude = 1 } ]\n",
        "scene.toml");
    pipelines::apply_override(scene, std::string(text));
  });
}
