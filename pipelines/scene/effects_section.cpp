#include "pipelines/scene/effects_section.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include <fmt/format.h>

#include "pipelines/text/scene_keys.hpp"

namespace microslip::pipelines {
namespace {

constexpr std::array<std::string_view, 3> settings{"auto", "on", "off"};

/// An effect that a key of another section switches: a setting that contradicts it is refused.
void check_effect_of_key(const SectionReader& s, std::string_view name, const std::string& setting,
                         const SceneDescription& scene) {
  const bool has = name == "higher_harmonics" ? scene.settings.harmonics.highest > 1
                   : name == "roughness"      ? is_rough(scene)
                                              : is_rate_dependent(scene);
  const char* key = name == "higher_harmonics" ? "response.harmonics"
                    : name == "roughness"      ? "contact.roughness"
                                               : "a law of contact.friction_coefficient";
  if (setting == "on" && !has) s.fail(name, fmt::format("needs {}", key), s.node(name));
  if (setting == "off" && has) {
    s.fail(name, fmt::format("contradicts {}: leave that out", key), s.node(name));
  }
}

/// Effects that may be left out, each alone.
void check_off(const SectionReader& s, std::string_view name, const SceneDescription& scene,
               bool has_residual) {
  if (name == "separation" || name == "mean_coupling") {
    s.fail(name, "is part of the normal motion: switch effects.normal_motion off", s.node(name));
  }
  if (name == "stability") {
    s.fail(name, "cannot be switched off: the steps along a curve use it; expected auto or on",
           s.node(name));
  }
  if (name == "residual" && has_residual) {
    s.fail(name, "contradicts modes.residual: give modes.residual = \"none\"", s.node(name));
  }
  if (name == "normal_motion" && is_rough(scene)) {
    s.fail(name, "contradicts contact.roughness: rough surfaces are felt by normal motion",
           s.node(name));
  }
}

}  // namespace

std::vector<std::pair<std::string, std::string>> read_effects(const SectionReader& s,
                                                              const SceneDescription& scene) {
  const bool has_residual = scene.settings.basis.residual != ResidualKind::none;
  // Simulated where the scene asks for them elsewhere.
  constexpr std::array<std::string_view, 3> by_key{"higher_harmonics", "roughness",
                                                   "rate_dependence"};
  std::vector<std::pair<std::string, std::string>> effects;
  for (const KeySpec& key : section_spec("effects").keys) {
    const std::string setting = s.word(key.name, settings);
    if (std::find(by_key.begin(), by_key.end(), key.name) != by_key.end()) {
      check_effect_of_key(s, key.name, setting, scene);
    } else if (setting == "off") {
      check_off(s, key.name, scene, has_residual);
    }
    if (key.name == "residual" && setting == "on" && !has_residual) {
      s.fail(key.name, "cannot be on: modal scenes and modes.residual = \"none\" have no residual",
             s.node(key.name));
    }
    effects.emplace_back(key.name, setting);
  }
  return effects;
}

Discretisation::Choice read_second_direction(const SectionReader& s) {
  using enum Discretisation::Choice;
  const std::string setting = s.word("second_direction", settings);
  return setting == "on" ? on : setting == "off" ? off : automatic;
}

}  // namespace microslip::pipelines
