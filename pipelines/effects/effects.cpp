#include "pipelines/effects/effects.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "pipelines/description/effects_left_out.hpp"
#include "pipelines/effects/curve_cost.hpp"
#include "pipelines/effects/effect_choice.hpp"
#include "pipelines/effects/effect_indicators.hpp"
#include "pipelines/effects/effect_sizes.hpp"
#include "pipelines/effects/motion_along_r.hpp"
#include "pipelines/effects/picture_cost.hpp"
#include "pipelines/structure/solver_time.hpp"
#include "pipelines/system/machine_speed.hpp"
#include "pipelines/system/scene_error.hpp"
#include "pipelines/text/effect_table.hpp"
#include "pipelines/text/rounded.hpp"

namespace microslip::pipelines {
namespace {

using enum Simulated;

bool can_have_residual(const SceneDescription& scene) {
  return as_written(scene).settings.basis.residual != ResidualKind::none;
}

/// Of a surface: kinds chain and bar have no key for them.
bool takes_rules(const SceneDescription& scene) {
  return scene.kind != "chain" && scene.kind != "bar";
}

/// What a scene lacks for some effects is no question of seconds.
bool can_be(std::string_view name, const EffectFacts& facts) {
  if (name == "second_direction") return can_be_along_r(facts);
  if (name == "normal_motion" || name == "mean_coupling") return facts.has_normal_stiffness;
  if (name == "roughness") return facts.has_normal_stiffness && takes_rules(facts.scene);
  if (name == "rate_dependence") return facts.has_friction && takes_rules(facts.scene);
  if (name == "moments") return has_area(facts.scene);
  if (name == "residual") return can_have_residual(facts.scene);
  return true;
}

/// An effect by which the method of the contact points, or the number of unknowns, goes.
struct Costly {
  std::string_view name;
  bool CurveEffects::*member;
};

const Costly* costly(std::string_view name) {
  static constexpr std::array effects{Costly{"normal_motion", &CurveEffects::normal_motion},
                                      Costly{"mean_coupling", &CurveEffects::mean},
                                      Costly{"second_direction", &CurveEffects::second_direction},
                                      Costly{"roughness", &CurveEffects::roughness},
                                      Costly{"rate_dependence", &CurveEffects::rate_dependence},
                                      Costly{"moments", &CurveEffects::areas},
                                      Costly{"residual", &CurveEffects::residual},
                                      Costly{"stability", &CurveEffects::stability}};
  const auto found = std::ranges::find(effects, name, &Costly::name);
  return found == effects.end() ? nullptr : &*found;
}

/// Those that are asked for; where none is, of one at every peak. Linear limits have none.
std::optional<double> cost_of_maps(const SceneDescription& scene) {
  SceneDescription drawn = scene;
  if (drawn.response->maps.empty()) drawn.response->maps = {MapName::peak};
  const double seconds = picture_seconds(drawn).maps;
  return seconds > 0.0 ? std::optional(seconds) : std::nullopt;
}

/// The equilibrium about which a rotating body vibrates, before the curves; where it is known how
/// large the mesh is.
std::optional<double> cost_of_rotation(const EffectFacts& facts) {
  const SceneDescription& rotating = as_written(facts.scene);
  if (facts.mesh == nullptr || given_modes(rotating) != nullptr) return std::nullopt;
  if (!rotating.rotation || rotating.rotation->speed == 0.0) return std::nullopt;
  SceneDescription at_rest = rotating;
  at_rest.rotation->speed = 0.0;
  const double n = 3.0 * static_cast<double>(facts.mesh->n_nodes());
  return equilibrium_seconds(n, rotating) - equilibrium_seconds(n, at_rest);
}

/// What the forecast does not tell from nothing takes no longer.
std::optional<double> if_any(double seconds, double all) {
  constexpr double of_all = 1e-3;
  return std::abs(seconds) > of_all * all ? std::optional(seconds) : std::nullopt;
}

/// What a run takes longer with an effect than without: before the curves, in them by the method of
/// their points, after them.
std::optional<double> cost_of(std::string_view name, const EffectFacts& facts) {
  if (!facts.scene.response || !facts.has_contact || in_time(facts.scene)) return std::nullopt;
  if (name == "maps") return cost_of_maps(facts.scene);
  if (name == "centrifugal") return cost_of_rotation(facts);
  if (name == "coexistence") return machine_slowness() * seconds_of_search(facts);
  if (name == "separation") return 0.0;  // the equations are those of contact that cannot open
  CurveEffects with = curve_effects(facts.scene, facts.both_directions);
  const double all = response_seconds(facts.scene, with).total();
  if (name == "nonlinearity") return all;                              // the limits take nothing
  if (name == "normal_motion" && with.roughness) return std::nullopt;  // they go together
  CurveEffects without = with;
  if (name == "higher_harmonics") {
    // Of those asked for; of one alone, of what choosing them would take.
    if (!with.several_harmonics) with.several_harmonics = with.chosen_harmonics = true;
    without.several_harmonics = without.chosen_harmonics = false;
  } else if (const Costly* effect = costly(name); effect != nullptr) {
    if (!can_be(name, facts)) return std::nullopt;
    with.*effect->member = true;
    without.*effect->member = false;
  } else {
    return std::nullopt;
  }
  const double seconds =
      response_seconds(facts.scene, with).total() - response_seconds(facts.scene, without).total();
  const bool of_loads = name == "normal_motion" || name == "mean_coupling";
  return of_loads ? if_any(seconds, all) : seconds;
}

constexpr const char* not_forecast =
    "; no cost is told: a motion in time is not forecast effect by effect";

/// Of an effect that has no cost in the table though a curve is asked for.
std::string why_no_cost(std::string_view name, const EffectFacts& facts) {
  if (!can_be(name, facts)) return "the scene cannot have it";
  struct Why {
    std::string_view name;
    const char* text;
  };
  static constexpr std::array reasons{
      Why{"normal_motion",
          "an evaluation takes about as long, how many more a curve needs is not known before"},
      Why{"mean_coupling", "it comes with normal_motion, and an evaluation takes as long without"},
      Why{"local_frames", "axes of their own take no time of a curve"},
      Why{"static_preload", "the static solution that tells its force tells its shape"},
      Why{"centrifugal", "modes and a static solution of the rotating body, before the curves"},
      Why{"wear", "a column of the maps, which takes no time of its own"},
      Why{"maps", "linear limits have none"},
  };
  const auto found = std::ranges::find(reasons, name, &Why::name);
  return found == reasons.end() ? "the forecast does not tell it apart" : found->text;
}

/// Whether the table warns of leaving an effect out: where the user did,
/// and what would be silent otherwise.
bool is_watched(const EffectRecord& effect) {
  constexpr std::array always{"higher_harmonics", "coexistence"};
  return effect.setting == "off" || std::ranges::count(always, effect.name) > 0;
}

/// Empty: it is not above.
std::string objection_above(const EffectRow& row, double indicator, double threshold) {
  if (indicator <= threshold) return {};
  return fmt::format("left out, and {} is {:.2g}, above {:.2g}", row.quantity, indicator,
                     threshold);
}

/// Left out, and the indicator says that it should not be.
std::string objection_to(const EffectRecord& effect, const EffectRow& row) {
  if (effect.simulated != no || !effect.indicator || !effect.threshold) return {};
  if (!is_watched(effect)) return {};
  return objection_above(row, *effect.indicator, *effect.threshold);
}

EffectRecord record_of(const EffectRow& row, const EffectFacts& facts) {
  EffectDecision decision = decide(row, facts);
  EffectRecord effect{std::string(row.name), facts.setting(row.name), decision.simulated,
                      std::move(decision.reason), decision.indicator};
  if (effect.indicator && std::isfinite(row.threshold)) {
    effect.threshold = decision.threshold.value_or(row.threshold);
  }
  const bool can_have = facts.has_contact && decision.can_be;
  if (effect.simulated != undecided && can_have) {
    effect.reason += fmt::format("; without it {}", row.lost);
  }
  effect.seconds = cost_of(row.name, facts);
  if (!decision.can_be && effect.seconds <= 0.0) effect.seconds.reset();  // nothing to be saved
  if (in_time(facts.scene)) {                                             // of all rows, told once
    if (row.name == "nonlinearity") effect.reason += not_forecast;
  } else if (!effect.seconds && effect.simulated == no && can_have && facts.scene.response) {
    effect.reason += fmt::format("; no cost is told: {}", why_no_cost(row.name, facts));
  }
  effect.refusal = std::move(decision.refusal);
  effect.objection = objection_to(effect, row);
  return effect;
}

/// Of an effect that is left out, by the model with it.
void tell_left_out(std::string_view name, const SceneDescription& scene,
                   const std::function<std::optional<double>(const SceneDescription&)>& indicator,
                   std::vector<EffectRecord>& effects) {
  if (left_out(scene, name) == nullptr) return;
  const auto effect = std::ranges::find(effects, name, &EffectRecord::name);
  if (effect == effects.end() || effect->indicator) return;
  try {
    effect->indicator = indicator(with_effect(scene, name));
  } catch (const RefusedError& error) {
    effect->reason += fmt::format("; its indicator is not known: {}", error.what());
    return;
  }
  const EffectRow& row = effect_row(name);
  effect->threshold = row.threshold;
  if (effect->indicator)
    effect->objection = objection_above(row, *effect->indicator, row.threshold);
}

}  // namespace

void tell_moments_left_out(const SceneDescription& scene, const SolvedStructure& structure,
                           std::vector<EffectRecord>& effects) {
  if (!scene.response) return;
  tell_left_out(
      "moments", scene,
      [&](const SceneDescription& with) {
        std::vector<std::string> warnings;  // those of the scene itself are told already
        return tilt_size(model_of(with, &structure, warnings), with);
      },
      effects);
}

void tell_residual_left_out(const SceneDescription& scene, const SolvedStructure& structure,
                            std::vector<EffectRecord>& effects) {
  tell_left_out(
      "residual", scene,
      [&](const SceneDescription& with) -> std::optional<double> {
        const SolvedStructure solved{structure.mesh, solve_structure(structure.mesh, with)};
        std::vector<std::string> warnings;
        return residual_share(model_of(with, &solved, warnings), with);
      },
      effects);
}

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
  // Curves may be quicker with an effect: areas that open bit by bit, instead of a point at once.
  const auto cost = [&](const std::optional<double>& seconds) {
    return seconds && *seconds < 0.0 ? fmt::format("saves {:.2g} s", -*seconds)
                                     : number(seconds, " s");
  };
  std::vector<std::string> lines{fmt::format("{:<18}{:<6}{:<6}{:>9}{:>9}{:>10}  {}", "effect",
                                             "sim.", "set", "indicator", "limit", "cost", "why")};
  for (const EffectRecord& effect : effects) {
    const char* simulated = effect.simulated == yes  ? "yes"
                            : effect.simulated == no ? "no"
                                                     : "later";
    lines.push_back(fmt::format("{:<18}{:<6}{:<6}{:>9}{:>9} {:>9}  {}", effect.name, simulated,
                                effect.setting, number(effect.indicator, ""),
                                number(effect.threshold, ""), cost(effect.seconds), effect.reason));
    if (effect.bound && std::isfinite(*effect.bound)) {
      lines.back() += fmt::format("; having it would change the highest peaks by {} at most",
                                  percent_text(*effect.bound));
      if (effect.bound_along.value_or(0.0) > *effect.bound) {
        lines.back() += fmt::format(", the curves at a frequency by {} of them",
                                    percent_text(*effect.bound_along));
      }
    }
    if (!effect.objection.empty()) lines.back() += "; but " + effect.objection;
  }
  return lines;
}

}  // namespace microslip::pipelines
