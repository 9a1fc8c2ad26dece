#include "pipelines/scene/scene_template.hpp"

#include <algorithm>
#include <array>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "pipelines/system/scene_error.hpp"
#include "pipelines/text/scene_keys.hpp"

namespace microslip::pipelines {
namespace {

/// Values for keys without a default: an example that runs.
using Examples = TemplateTexts;

const Examples& mesh_examples() {
  static const Examples values{
      {"model.file", "\"blade.msh\""},
      {"model.length_unit", "\"m\""},
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
       "[\n  { at = \"B\", direction = [1, 0, 0], amplitude = \"0.5 N\", phase = \"0 deg\" },\n]"},
      {"response.output", "{ at = \"A\", direction = [1, 0, 0] }"},
      {"response.frequency", "[\"280 Hz\", \"340 Hz\"]"},
      {"response.preload", "[\"free\", 100, 1000, \"stuck\"]"},
      {"response.maps", "[\"peak\"]"},
  };
  return values;
}

const Examples& step_examples() {
  static const Examples values = [] {
    Examples examples = mesh_examples();
    examples["model.file"] = "\"blade.step\"";
    examples["model.element_size"] = "\"4 mm\"";
    examples["model.length_unit"] = "";
    examples["faces"] =
        "root = { normal = [0, -1, 0], near = [0, 0, 0] }\n"
        "contact = { point = [\"30 mm\", \"30 mm\", \"0 mm\"] }\n";
    examples["excitation.forces"] =
        "[\n  { at = [\"-13.0 mm\", \"149.1 mm\", \"-13.8 mm\"], direction = [1, 0, 0], "
        "amplitude = \"0.5 N\", phase = \"0 deg\" },\n]";
    examples["response.output"] =
        "{ at = [\"-1.5 mm\", \"149.1 mm\", \"-1.0 mm\"], direction = [1, 0, 0] }";
    return examples;
  }();
  return values;
}

const Examples& modes_examples() {
  static const Examples values = [] {
    Examples examples = mesh_examples();
    examples["model.file"] = "\"blade.frd\"";
    examples["model.mesh"] = "\"blade.inp\"";
    examples["model.length_unit"] = "\"mm\"";
    return examples;
  }();
  return values;
}

const Examples& modal_examples() {
  static const Examples values{
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

const Examples& bar_examples() {
  static const Examples values{
      {"model.youngs_modulus", "\"200 GPa\""},
      {"model.area", "\"1 cm^2\""},
      {"model.density", "\"7800 kg/m^3\""},
      {"model.length", "\"1.03 m\""},
      {"model.end_stiffness", "\"80 kN/mm\""},
      {"contact.tangential_stiffness", "\"1e7 N/m^2\""},
      {"contact.friction_coefficient", "0.3"},
      {"contact.load", "\"2000*(0.2 + 0.8*(2*x/L - 1)^2)\""},
      {"excitation.force", "\"200 N\""},
      {"response.frequency", "[\"900 Hz\", \"1200 Hz\"]"},
      {"response.maps", "[\"peak\"]"},
  };
  return values;
}

const Examples& chain_examples() {
  static const Examples values{
      {"model.masses", "[\"1 kg\", \"1 kg\"]"},
      {"model.springs", "[\"41 kN/m\", \"41 kN/m\"]"},
      {"modes.damping_ratio", "\"2 %\""},
      {"excitation.forces", "[\n  { at = \"m2\", amplitude = \"10 N\", phase = \"0 deg\" },\n]"},
      {"contact.points",
       "[\n  { slip = \"m1\", tangential_stiffness = \"40 kN/m\", friction_coefficient = 0.5 "
       "},\n]"},
      {"response.output", "\"m2\""},
      {"response.frequency", "[\"18 Hz\", \"28 Hz\"]"},
      {"response.preload", "[\"free\", 10, 30, 100, \"stuck\"]"},
  };
  return values;
}

const Examples& block_examples() {
  static const Examples values{
      {"model.mass", "\"1 kg\""},
      {"model.moments_of_inertia", "[0.002, 0.003, 0.002]"},
      {"model.height", "\"20 mm\""},
      {"model.stiffness", "[\"16 kN/m\", \"20 kN/m\", \"16 kN/m\"]"},
      {"model.rotational_stiffness", "[60, 60, 60]"},
      {"modes.damping_ratio", "\"2 %\""},
      {"contact.cells", "[4, 4]"},
      {"contact.size", "[\"0.1 m\", \"0.1 m\"]"},
      {"contact.normal_stiffness", "\"40 kN/m\""},
      {"contact.tangential_stiffness", "\"40 kN/m\""},
      {"contact.friction_coefficient", "0.5"},
      {"contact.roughness", "{ law = \"cubic\", height = \"0.5 mm\" }"},
      {"excitation.forces",
       "[\n  { at = [0, 0, 0], force = [\"10 N\", 0, 0], moment = [0, 0, 0], phase = \"0 deg\" "
       "},\n]"},
      {"response.output", "{ at = [0, 0, 0], direction = [1, 0, 0] }"},
      {"response.frequency", "[\"18 Hz\", \"40 Hz\"]"},
      {"response.preload", "[\"free\", 20, 40, \"stuck\"]"},
  };
  return values;
}

const Examples& examples_of(std::string_view kind) {
  if (kind == "step") return step_examples();
  if (kind == "modes") return modes_examples();
  if (kind == "modal") return modal_examples();
  if (kind == "bar") return bar_examples();
  if (kind == "chain") return chain_examples();
  if (kind == "block") return block_examples();
  return mesh_examples();
}

/// Meaning, unit, range and default of a key. @param value  as the template writes it.
std::string description(const KeySpec& key, const std::string& value) {
  std::string text(key.meaning);
  if (!key.unit.empty() && key.unit != "1") text += fmt::format(" [{}]", key.unit);
  if (key.type == KeyType::number || key.type == KeyType::integer) text += "; " + range_text(key);
  if (!key.preset.empty() && value != key.preset) text += fmt::format("; default {}", key.preset);
  return text;
}

/// The keys of the tables in a list, told above the list.
void add_table_keys(std::string& text, std::string_view spec) {
  for (const KeySpec& key : section_spec(spec).keys) {
    text += fmt::format("#   {}: {}{}\n", key.name, description(key, ""),
                        key.optional ? "; optional" : "");
  }
}

void add_section(std::string& text, std::string_view name, std::string_view kind,
                 const TemplateTexts& values, const TemplateTexts& remarks) {
  text += fmt::format("\n[{}]\n", name);
  if (name == "points") {
    text += fmt::format(
        "# names of your own for `at`: {} [m]; optional\n# mid = [\"10 mm\", \"100 mm\", \"0 "
        "mm\"]\n",
        point_key("").meaning);
  }
  if (name == "faces") {
    text += "# names of your own for faces, each a table, or a list of tables:\n";
    add_table_keys(text, "face");
    text += values.at("faces");
  }
  for (const KeySpec& key : section_spec(name, kind).keys) {
    std::string value(key.preset);
    if (name == "model" && key.name == "kind") value = fmt::format("\"{}\"", kind);
    const auto example = values.find(fmt::format("{}.{}", name, key.name));
    if (example != values.end()) value = example->second;
    if (const auto remark = remarks.find(fmt::format("{}.{}", name, key.name));
        remark != remarks.end()) {
      text += fmt::format("# {}\n", remark->second);
    }
    text += "# " + description(key, value);
    if (value.empty()) {
      text += fmt::format("; optional\n# {} =\n", key.name);
      continue;
    }
    text += '\n';
    if (name == "modal" && key.name == "points") add_table_keys(text, "modal.point");
    if (kind == "chain" && name == "contact") add_table_keys(text, "contact.chain.point");
    if (kind == "block" && key.name == "forces") add_table_keys(text, "force.block");
    text += fmt::format("{} = {}\n", key.name, value);
  }
}

}  // namespace

std::string scene_template(std::string_view kind, const TemplateTexts& values,
                           const TemplateTexts& remarks) {
  constexpr std::array<std::string_view, 8> kinds{"blade", "step", "mesh",  "modes",
                                                  "modal", "bar",  "chain", "block"};
  if (std::find(kinds.begin(), kinds.end(), kind) == kinds.end()) {
    throw SceneError(fmt::format("init: kind \"{}\" is not available; expected one of: {}", kind,
                                 fmt::join(kinds, ", ")));
  }
  std::string text = fmt::format(
      "# A scene of kind \"{0}\". Values are SI, or texts with a unit: \"210 GPa\", \"2.5 mm\", "
      "\"0.2 %\".\ntitle = \"A {0} scene\"\n",
      kind);
  TemplateTexts all = values;
  all.insert(examples_of(kind).begin(), examples_of(kind).end());
  all.emplace("accuracy.tolerance", "\"2 %\"");
  for (const std::string_view section : sections_of_kind(kind)) {
    add_section(text, section, kind, all, remarks);
  }
  return text;
}

}  // namespace microslip::pipelines
