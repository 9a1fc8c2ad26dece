#include "pipelines/scene_template.hpp"

#include <map>

#include <fmt/format.h>

#include "pipelines/scene_error.hpp"
#include "pipelines/scene_keys.hpp"

namespace microslip::pipelines {
namespace {

/// Values for keys without a default: an example that runs.
const std::map<std::string, std::string, std::less<>>& examples() {
  static const std::map<std::string, std::string, std::less<>> values{
      {"model.file", "\"blade.msh\""},
      {"material.youngs_modulus", "\"210 GPa\""},
      {"material.poissons_ratio", "0.3"},
      {"material.density", "\"7800 kg/m^3\""},
      {"supports.clamped", "[\"root\"]"},
      {"contact.surface", "\"contact\""},
      {"contact.slip_direction", "[0, 1, 0]"},
      {"contact.friction_coefficient", "0.4"},
      {"contact.normal_stiffness", "\"1e11 N/m^3\""},
      {"contact.tangential_stiffness", "\"1e11 N/m^3\""},
      {"excitation.forces",
       "[\n  { at = \"B\", direction = [1, 0, 0], amplitude = \"0.5 N\", phase = 0 },\n]"},
      {"response.output", "{ at = \"A\", direction = [1, 0, 0] }"},
      {"response.frequency", "[\"280 Hz\", \"340 Hz\"]"},
      {"response.preload", "[\"free\", 100, 1000, \"stuck\"]"},
      {"response.maps", "[\"peak\"]"},
  };
  return values;
}

const std::map<std::string, std::string, std::less<>>& modal_examples() {
  static const std::map<std::string, std::string, std::less<>> values{
      {"modal.frequency", "[15.9, 41.4]"},
      {"modal.damping_ratio", "[0.01, 0.01]"},
      {"modal.force_sine", "[0.0, 0.3]"},
      {"modal.force_cosine", "[1.0, 0.4]"},
      {"modal.output", "[0.9, 0.35]"},
      {"modal.points",
       "[\n  { weight = 1, tangential_stiffness = 1e4, normal_stiffness = 1e4, "
       "friction_coefficient = 0.3, preload = 2, phi_u_1 = 0.8, phi_u_2 = -0.5, phi_v_1 = 0.1, "
       "phi_v_2 = 0.2 },\n]"},
      {"response.frequency", "[\"5 Hz\", \"50 Hz\"]"},
  };
  return values;
}

void add_section(std::string& text, std::string_view name, std::string_view spec,
                 const std::map<std::string, std::string, std::less<>>& values,
                 std::string_view kind) {
  text += fmt::format("\n[{}]\n", name);
  for (const KeySpec& key : section_spec(spec).keys) {
    std::string value(key.preset);
    if (name == "model" && key.name == "kind") value = fmt::format("\"{}\"", kind);
    const auto example = values.find(fmt::format("{}.{}", name, key.name));
    if (example != values.end()) value = example->second;
    text += fmt::format("# {}", key.meaning);
    if (!key.unit.empty() && key.unit != "1") text += fmt::format(" [{}]", key.unit);
    if (key.type == KeyType::number || key.type == KeyType::integer) {
      text += "; " + range_text(key);
    }
    if (!key.preset.empty() && value != key.preset) text += fmt::format("; default {}", key.preset);
    text += value.empty() ? fmt::format("; optional\n# {} =\n", key.name)
                          : fmt::format("\n{} = {}\n", key.name, value);
  }
}

}  // namespace

std::string scene_template(std::string_view kind) {
  if (kind != "blade" && kind != "mesh" && kind != "modal") {
    throw SceneError(fmt::format("init: kind \"{}\" is not available; expected one of: blade, mesh, "
                                 "modal", kind));
  }
  std::string text = fmt::format(
      "# A scene of kind \"{0}\". Values are SI, or texts with a unit: \"210 GPa\", \"2.5 mm\", "
      "\"0.2 %\".\ntitle = \"A {0} scene\"\n",
      kind);
  const bool modal = kind == "modal";
  for (const std::string_view section : sections_of_kind(kind)) {
    std::string spec(section);
    if (section == "model") spec = fmt::format("model.{}", kind);
    if (section == "response" && modal) spec = "response.modal";
    add_section(text, section, spec, modal ? modal_examples() : examples(), kind);
  }
  return text;
}

}  // namespace microslip::pipelines
