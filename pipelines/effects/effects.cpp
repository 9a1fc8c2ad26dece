#include "pipelines/effects/effects.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "pipelines/description/effects_left_out.hpp"
#include "pipelines/effects/curve_cost.hpp"
#include "pipelines/effects/effect_choice.hpp"
#include "pipelines/text/effect_table.hpp"

namespace microslip::pipelines {
namespace {

using enum Simulated;

constexpr double in_percent = 100.0;

bool can_have_residual(const SceneDescription& scene) {
  return as_written(scene).settings.basis.residual != ResidualKind::none;
}

/// An effect by which the method of the contact points, or the number of unknowns, goes.
struct Costly {
  std::string_view name;
  bool CurveEffects::*member;
  bool (*needs)(const SceneDescription&);  ///< for its cost to be told; nullptr: nothing
};

const Costly* costly(std::string_view name) {
  static constexpr std::array effects{
      Costly{"second_direction", &CurveEffects::second_direction, nullptr},
      Costly{"roughness", &CurveEffects::roughness, nullptr},
      Costly{"rate_dependence", &CurveEffects::rate_dependence, nullptr},
      Costly{"moments", &CurveEffects::areas, has_area},
      Costly{"residual", &CurveEffects::residual, can_have_residual},
      Costly{"stability", &CurveEffects::stability, nullptr}};
  const auto found = std::ranges::find(effects, name, &Costly::name);
  return found == effects.end() ? nullptr : &*found;
}

/// What the curves take longer with an effect than without, where the method of the points tells.
std::optional<double> cost_of(std::string_view name, const EffectFacts& facts) {
  if (!facts.scene.response || !facts.has_contact || in_time(facts.scene)) return std::nullopt;
  if (name == "coexistence") return seconds_of_search(facts);
  if (name == "separation") return 0.0;  // the equations are those of contact that cannot open
  CurveEffects with = curve_effects(facts.scene, facts.both_directions);
  const double all = response_seconds(facts.scene, with).total();
  if (name == "nonlinearity") return all;  // the limits take nothing
  CurveEffects without = with;
  if (name == "higher_harmonics") {
    with.several_harmonics = with.chosen_harmonics = true;
    without.several_harmonics = without.chosen_harmonics = false;
  } else if (const Costly* effect = costly(name); effect != nullptr) {
    if (effect->needs != nullptr && !effect->needs(facts.scene)) return std::nullopt;
    with.*effect->member = true;
    without.*effect->member = false;
  } else {
    return std::nullopt;
  }
  return response_seconds(facts.scene, with).total() -
         response_seconds(facts.scene, without).total();
}

/// Whether the table warns of leaving an effect out: where the user did,
/// and what would be silent otherwise.
bool is_watched(const EffectRecord& effect, const EffectFacts& facts) {
  if (effect.setting == "off" || effect.name == "higher_harmonics") return true;
  return effect.name == "coexistence" && is_single_frequency(facts.scene);
}

/// Left out, and the indicator says that it should not be.
std::string objection_to(const EffectRecord& effect, const EffectRow& row,
                         const EffectFacts& facts) {
  if (effect.simulated != no || !effect.indicator || !effect.threshold) return {};
  if (*effect.indicator <= *effect.threshold || !is_watched(effect, facts)) return {};
  return fmt::format("left out, and {} is {:.2g}, above {:.2g}", row.quantity, *effect.indicator,
                     *effect.threshold);
}

EffectRecord record_of(const EffectRow& row, const EffectFacts& facts) {
  EffectDecision decision = decide(row, facts);
  EffectRecord effect{std::string(row.name), facts.setting(row.name), decision.simulated,
                      std::move(decision.reason), decision.indicator};
  if (effect.indicator && std::isfinite(row.threshold)) {
    effect.threshold = decision.threshold.value_or(row.threshold);
  }
  if (effect.simulated == no && facts.has_contact) {
    effect.reason += fmt::format("; without it {}", row.lost);
  }
  effect.seconds = cost_of(row.name, facts);
  effect.refusal = std::move(decision.refusal);
  effect.objection = objection_to(effect, row, facts);
  return effect;
}

}  // namespace

std::vector<EffectRecord> effects_of(const SceneDescription& scene, const ReducedModel* model,
                                     const mesh::Mesh* mesh) {
  const EffectFacts facts = effect_facts(scene, model, mesh);
  std::vector<EffectRecord> effects;
  effects.reserve(effect_table.size());
  for (const EffectRow& row : effect_table) effects.push_back(record_of(row, facts));
  return effects;
}

const EffectRecord& effect_in(const std::vector<EffectRecord>& effects, std::string_view name) {
  const auto found = std::ranges::find(effects, name, &EffectRecord::name);
  if (found == effects.end()) throw std::out_of_range("no effect " + std::string(name));
  return *found;
}

std::vector<std::string> effect_lines(const std::vector<EffectRecord>& effects) {
  const auto number = [](const std::optional<double>& value, const char* unit) {
    return value ? fmt::format("{:.3g}{}", *value, unit) : std::string("-");
  };
  std::vector<std::string> lines{fmt::format("{:<18}{:<6}{:<6}{:>9}{:>9}{:>10}  {}", "effect",
                                             "sim.", "set", "indicator", "limit", "cost", "why")};
  for (const EffectRecord& effect : effects) {
    const char* simulated = effect.simulated == yes  ? "yes"
                            : effect.simulated == no ? "no"
                                                     : "later";
    lines.push_back(fmt::format("{:<18}{:<6}{:<6}{:>9}{:>9}{:>10}  {}", effect.name, simulated,
                                effect.setting, number(effect.indicator, ""),
                                number(effect.threshold, ""), number(effect.seconds, " s"),
                                effect.reason));
    if (effect.bound && std::isfinite(*effect.bound)) {
      lines.back() += fmt::format("; having it would change the highest peaks by {:.2g} % at most",
                                  in_percent * *effect.bound);
    }
    if (!effect.objection.empty()) lines.back() += "; but " + effect.objection;
  }
  return lines;
}

}  // namespace microslip::pipelines
