#include "pipelines/effects/effect_choice.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "pipelines/description/curve_request.hpp"
#include "pipelines/description/effects_left_out.hpp"
#include "pipelines/effects/contact_effects.hpp"
#include "pipelines/effects/effect_sizes.hpp"
#include "pipelines/effects/motion_along_r.hpp"
#include "pipelines/model/contact_frame.hpp"
#include "pipelines/model/contact_stage.hpp"
#include "pipelines/model/curve_load.hpp"
#include "pipelines/system/scene_error.hpp"
#include "pipelines/text/rounded.hpp"

namespace microslip::pipelines {
namespace {

using enum Simulated;

constexpr double percent = 100.0;
constexpr int starts_of_a_search = 12;
// Of one that nobody has asked for, per frequency of a curve, where twelve take long: of three two
// found what twelve did.
constexpr int starts_beside_a_curve = 4;
constexpr double bearable_search = 60.0;  // [s]: what a scene may wait for without having asked
constexpr double short_search = 0.1;      // [s] beside one curve: for what is seldom there
constexpr const char* in_reach =          // of `coexistence`, after which resonance
    "closes a gap, opens the contact or overcomes friction that falls with speed";
constexpr const char* limits_alone = "only the limits are asked for";
constexpr const char* later = "told when the modes are known, by `run`";

EffectDecision by(bool simulated, std::string reason, std::optional<double> indicator = {}) {
  return {simulated ? yes : no, std::move(reason), indicator};
}

/// Of what nothing in the scene gives: why.
EffectDecision cannot(std::string reason) {
  EffectDecision decision{no, std::move(reason)};
  decision.can_be = false;
  return decision;
}

/// "2.5 times", for a sentence that goes on with what.
std::string times_text(double value) {
  return std::isinf(value) ? "any multiple of" : fmt::format("{:.2g} times", value);
}

EffectDecision nonlinearity(const EffectFacts& facts) {
  if (!facts.has_contact) return cannot("the scene has no contact");
  if (!facts.has_friction && !facts.has_normal_stiffness) {
    return cannot("no point has friction or normal stiffness");
  }
  if (facts.setting("nonlinearity") == "off") return cannot(limits_alone);
  if (is_rough(facts.scene)) return by(true, "rough surfaces are springs under no load");
  if (facts.model == nullptr) return {undecided, later};
  if (!facts.scene.response) return {undecided, "no [response] is asked for"};
  if (!facts.reach) return cannot(limits_alone);
  const double slip = facts.reach->slip;
  const std::string text = fmt::format(
      "the linear limits drive a point to {} what holds it from slipping, opening or closing",
      times_text(slip));
  if (slip > effect_row("nonlinearity").threshold || facts.setting("nonlinearity") == "on") {
    return {yes, text, slip};
  }
  return {undecided, text + ": the run proves that it holds, or solves", slip};
}

/// Of the contact points, where some are open under a load that presses others: without normal
/// motion they never close.
std::string open_points(const EffectFacts& facts) {
  if (facts.model == nullptr) return {};
  Eigen::Index n_open = 0;
  Eigen::Index n = 0;
  for (const contact::Patch& patch : facts.model->patches) {
    n_open += (patch.cells.preload_field.array() < 0.0).count();
    n += patch.cells.size();
  }
  if (n_open == 0) return {};
  return fmt::format(", so that {} of {} contact points are open at rest and never touch", n_open,
                     n);
}

EffectDecision normal_motion(const EffectFacts& facts) {
  if (facts.setting("normal_motion") == "off") {
    EffectDecision decision = by(false, "effects.normal_motion = \"off\"" + open_points(facts));
    if (facts.reach) decision.indicator = facts.reach->load;
    return decision;
  }
  if (!facts.has_normal_stiffness) return cannot("no contact has normal stiffness");
  if (facts.model == nullptr) return {undecided, later};
  if (!facts.reach) return by(true, "normal springs belong to the stuck limit");
  const auto is_on = [&](std::initializer_list<std::string_view> names) {  // parts of it as well
    return std::ranges::any_of(names, [&](auto name) { return facts.setting(name) == "on"; });
  };
  const double share = normal_energy_share(*facts.model, facts.scene);
  const double indicator = std::max(facts.reach->load, share);
  const bool called_for = indicator > effect_row("normal_motion").threshold;
  const bool asked =
      is_rough(facts.scene) || is_on({"normal_motion", "separation", "mean_coupling"});
  return by(called_for || asked,
            fmt::format("the load changes by {} its value in the linear limits, normal springs "
                        "hold {:.2g} % of the strain energy",
                        times_text(facts.reach->load), percent * share),
            indicator);
}

/// What comes with the variation of the load.
EffectDecision with_normal_motion(const EffectFacts& facts, const char* why,
                                  double ContactReach::*indicator) {
  EffectDecision decision = normal_motion(facts);
  decision.indicator.reset();
  if (facts.reach) decision.indicator = (*facts.reach).*indicator;
  if (decision.simulated == yes) decision.reason = why;
  return decision;
}

EffectDecision separation(const EffectFacts& facts) {
  EffectDecision decision =
      with_normal_motion(facts, "the contact is one-sided", &ContactReach::load);
  if (decision.simulated != yes) return decision;
  const bool opens = !(decision.indicator <= effect_row("separation").threshold);
  if (facts.setting("separation") != "off") {
    if (!opens) {
      decision.reason += ": no point opens in the linear limits; asking for it costs nothing";
    }
    return decision;
  }
  if (opens) {
    decision.refusal = fmt::format(
        "the load changes by {} its value in the linear limits, so that points open; held closed "
        "they would pull, and friction has no law there: leave it to \"auto\", raise "
        "the preload, or keep the load that of rest by effects.normal_motion = \"off\"",
        times_text(decision.indicator.value_or(HUGE_VAL)));
    return decision;
  }
  decision.simulated = no;
  decision.reason =
      "no point opens in the linear limits: as long as none does on the curves, they are those of "
      "contact that cannot open";
  return decision;
}

/// "off" of what has the mean all the same.
EffectDecision mean_kept(EffectDecision decision) {
  const double change = *decision.indicator;
  if (change > effect_row("mean_coupling").threshold) {
    decision.refusal = fmt::format(
        "a motion integrated in time has its mean, which changes the load by up to {} its value in "
        "the linear limits: leave it to \"auto\", give response.method = \"harmonic_balance\", or "
        "keep the load that of rest by effects.normal_motion = \"off\"",
        times_text(change));
    return decision;
  }
  decision.reason = fmt::format(
      "kept although it is \"off\", since a motion integrated in time has its mean: in the linear "
      "limits that changes the load by {} its value at most",
      times_text(change));
  return decision;
}

EffectDecision mean_coupling(const EffectFacts& facts) {
  EffectDecision decision =
      with_normal_motion(facts, "the mean approach changes the load", &ContactReach::bias_load);
  if (decision.simulated != yes || facts.setting("mean_coupling") != "off") return decision;
  if (!decision.indicator) return decision;  // nothing that can move it is asked for
  if (in_time(facts.scene)) return mean_kept(std::move(decision));
  decision.simulated = no;
  decision.reason = "effects.mean_coupling = \"off\": contact sees the vibration about the mean";
  if (facts.model->frequency.minCoeff() <= 0.0) {
    decision.refusal =
        "a mode without stiffness of its own has no mean but that which contact holds: leave it to "
        "\"auto\", or hold the structure by supports";
  }
  return decision;
}

bool has_both_directions(const SceneDescription& scene, double motion_ratio) {
  using enum Discretisation::Choice;
  const Discretisation::Choice choice = scene.settings.second_direction;
  return choice == on || (choice == automatic && motion_ratio > least_motion_along_r(scene));
}

EffectDecision second_direction(const EffectFacts& facts) {
  if (!facts.has_contact) return cannot("the scene has no contact");
  const bool is_open = facts.scene.settings.second_direction == Discretisation::Choice::automatic;
  if (facts.model == nullptr && is_open) return {undecided, later};
  if (facts.model == nullptr) {
    return by(facts.both_directions, std::string("how much the patch moves along r is ") + later);
  }
  if (!facts.both_directions && !can_be_along_r(facts)) {
    return cannot("nothing that rubs can move along r");
  }
  return {facts.both_directions ? yes : no,
          fmt::format("motion along r is {} of that along p in the linear limits",
                      percent_text(facts.motion_ratio)),
          facts.motion_ratio, least_motion_along_r(facts.scene)};
}

/// The linear limits alone know neither harmonics nor roughness nor a speed of slip.
bool has_load(const EffectFacts& facts) { return facts.has_range() && facts.reach.has_value(); }

EffectDecision higher_harmonics(const EffectFacts& facts) {
  const bool several = facts.scene.settings.harmonics.highest > 1 || in_time(facts.scene);
  EffectDecision decision{several ? yes : no, harmonics_text(facts.scene)};
  if (facts.scene.settings.harmonics.chosen()) decision.simulated = undecided;
  if (!facts.scene.response || !facts.has_contact || in_time(facts.scene)) return decision;
  if (!has_load(facts)) {
    if (decision.simulated == no) decision.reason = "the first alone is kept";
    return decision;
  }
  const HarmonicAnswer most = harmonic_answer(*facts.model, facts.scene);
  decision.indicator = most.ratio;
  if (decision.simulated == no) {
    decision.reason = fmt::format(
        "the first alone is kept; of its multiples order {}, at {:.4g} Hz, moves the patch most",
        most.order, most.frequency / (2.0 * std::numbers::pi));
  }
  return decision;
}

/// Above which `auto` simulates an effect that a key gives: that of the table, which keeps changes
/// of a peak well below 1 %, a part of it where less is tolerated.
double limit_of(const EffectRow& row, const SceneDescription& scene) {
  constexpr double tolerance = 0.01;
  const double asked = scene.accuracy.tolerance;
  return asked > 0.0 ? row.threshold * std::min(1.0, asked / tolerance) : row.threshold;
}

/// Whether a run can prove what `auto` leaves out of a description, and gains by it: a motion in
/// time would be integrated once more with it, other values of a key that is searched over may call
/// for it where that of the scene does not.
bool may_leave_out(const EffectFacts& facts, std::string_view name) {
  if (facts.setting(name) != "auto" || in_time(facts.scene)) return false;
  if (!facts.scene.accuracy.error_budget) return false;
  const auto& optimum = facts.scene.response->optimum;
  return !optimum || optimum->of_preload();
}

/// Of an effect that a key gives: `auto` leaves it out below its limit.
EffectDecision given_by_key(const EffectFacts& facts, std::string_view name, const char* reason,
                            double (*size)(const ReducedModel&, const SceneDescription&)) {
  if (facts.model == nullptr && facts.setting(name) == "auto") return {undecided, later};
  if (!has_load(facts)) return by(true, reason);
  EffectDecision decision = by(true, reason, size(*facts.model, facts.scene));
  decision.threshold = limit_of(effect_row(name), facts.scene);
  if (may_leave_out(facts, name)) {
    decision.simulated = *decision.indicator > *decision.threshold ? yes : no;
  }
  return decision;
}

EffectDecision roughness(const EffectFacts& facts) {
  if (!is_rough(facts.scene)) return cannot("no contact.roughness is given: surfaces are smooth");
  return given_by_key(facts, "roughness", "contact.roughness is given", roughness_size);
}

EffectDecision rate_dependence(const EffectFacts& facts) {
  if (!is_rate_dependent(facts.scene)) {
    return cannot("no law of the slip speed is given: the friction coefficient is constant");
  }
  return given_by_key(facts, "rate_dependence", "the friction coefficient follows the slip speed",
                      friction_change);
}

EffectDecision moments(const EffectFacts& facts) {
  if (!facts.has_contact) return cannot("the scene has no contact");
  if (!has_area(facts.scene)) return cannot("every contact is a point");
  EffectDecision decision =
      by(true, "contact acts on an area: points at several places share the load");
  if (facts.has_range()) decision.indicator = tilt_size(*facts.model, facts.scene);
  return decision;
}

EffectDecision residual(const EffectFacts& facts) {
  const ResidualKind kind = facts.scene.settings.basis.residual;
  const bool modal = std::holds_alternative<ModalModel>(facts.scene.model);
  if (!facts.has_contact) return cannot("the scene has no contact");
  if (kind == ResidualKind::none) {
    return modal ? cannot("the given stiffness is used as it is")
                 : by(false, "modes.residual = \"none\"");
  }
  EffectDecision decision =
      by(true, kind == ResidualKind::attachment
                   ? "static shapes of the contact and of the forces stand for omitted modes"
                   : "flexibility of omitted modes stands in series with the contact stiffness");
  if (facts.model != nullptr) decision.indicator = residual_share(*facts.model, facts.scene);
  return decision;
}

struct FaceShape {
  double off_plane = 0.0;
  bool local_frames = false;
};

/// Of the contacts of a mesh, as far as it is known.
std::vector<FaceShape> face_shapes(const EffectFacts& facts) {
  std::vector<FaceShape> faces;
  if (facts.model != nullptr) {
    for (const contact::Patch& patch : facts.model->patches) {
      faces.push_back({patch.off_plane, patch.cells.normals.rows() > 0});
    }
  } else if (facts.mesh != nullptr) {
    for (const ContactDescription& contact : facts.scene.contacts) {
      faces.push_back({off_plane(*facts.mesh, contact), has_local_frames(*facts.mesh, contact)});
    }
  }
  return faces;
}

EffectDecision local_frames(const EffectFacts& facts) {
  if (!facts.has_contact) return cannot("the scene has no contact");
  if (facts.scene.contacts.empty()) {
    return cannot("contact points have the directions of the modes given for them");
  }
  const std::vector<FaceShape> faces = face_shapes(facts);
  const std::string setting = facts.setting("local_frames");
  if (faces.empty() && setting == "auto") return {undecided, "told when the mesh is read"};
  const double off =
      faces.empty() ? 0.0 : std::ranges::max(faces, {}, &FaceShape::off_plane).off_plane;
  const bool local = std::ranges::any_of(faces, &FaceShape::local_frames);
  if (!local && setting == "auto" && off < plane_to_rounding) {
    EffectDecision plane = cannot("the face is plane");
    plane.indicator = off;
    return plane;
  }
  EffectDecision decision =
      by(local || setting == "on",
         setting == "off" ? "effects.local_frames = \"off\": a face is simulated as its mean plane"
         : local ? "normal and slip direction are those of every place of a face that is not plane"
                 : fmt::format("nodes are off the mean plane by {} of the size of the face",
                               percent_text(off)));
  if (!faces.empty()) decision.indicator = off;
  return decision;
}

EffectDecision static_preload(const EffectFacts& facts) {
  if (!facts.has_contact) return cannot("the scene has no contact");
  if (has_static_preload(facts.scene)) {
    return by(true, "contact.preload = \"static\": pressure at rest is solved for, gaps and all",
              facts.model != nullptr ? facts.model->static_variation : std::nullopt);
  }
  const bool given = std::ranges::any_of(
      facts.scene.contacts, [](const auto& contact) { return contact.preload_field.has_value(); });
  return cannot(facts.scene.contacts.empty() ? "pressure at rest is given with the points"
                : given                      ? "pressure at rest is contact.preload_field"
                                             : "pressure at rest is uniform");
}

/// Square of the speed over the lowest natural frequency.
double speed_size(const EffectFacts& facts, const fem::Rotation& rotation) {
  const double lowest = facts.model->frequency.minCoeff();
  return lowest > 0.0 ? std::pow(rotation.speed / lowest, 2) : HUGE_VAL;
}

EffectDecision centrifugal(const EffectFacts& facts) {
  if (std::holds_alternative<ModalModel>(facts.scene.model) ||
      given_modes(facts.scene) != nullptr) {
    return cannot("modes are given, with or without rotation");
  }
  const auto& rotation = facts.scene.rotation;
  if (!rotation || rotation->speed == 0.0) return cannot("no static.speed is given");
  EffectDecision decision = by(true, "the structure rotates");
  if (facts.model != nullptr) decision.indicator = speed_size(facts, *rotation);
  return decision;
}

EffectDecision stability(const EffectFacts& facts) {
  const bool several = facts.scene.settings.harmonics.highest > 1;
  return by(
      facts.has_contact,
      !facts.has_contact             ? "a linear scene is stable"
      : is_linear_study(facts.scene) ? "the limits are linear, and stable"
      : in_time(facts.scene) ? "a motion that repeats with every period of the excitation is stable"
      : several ? "Hill's exponents of every point with several harmonics, where they can tell; in "
                  "scenes of few modes and points the multipliers of a period in time"
                : "slow-flow eigenvalues of every point");
}

EffectDecision maps(const EffectFacts& facts) {
  const bool asked = facts.scene.response && !facts.scene.response->maps.empty();
  return by(asked, asked ? "response.maps asks for them" : "response.maps asks for none");
}

EffectDecision wear(const EffectFacts& facts) {
  if (!has_wear(facts.scene)) return cannot("no contact.wear_coefficient is given");
  const bool drawn = maps(facts).simulated == yes;
  return by(drawn, drawn ? "depth per period by Archard's law"
                         : "response.maps asks for no map to show it in");
}

bool is_short_search(const SceneDescription& scene, bool both_directions, int n_starts) {
  return search_of_a_curve(scene, curve_effects(scene, both_directions), n_starts) <= short_search;
}

EffectDecision coexistence(const EffectFacts& facts) {
  const SceneDescription& scene = facts.scene;
  EffectDecision decision;
  const double threshold = effect_row("coexistence").threshold;
  const bool one = is_single_frequency(scene);
  if (facts.reach) decision.indicator = one ? facts.reach->nearby : facts.reach->outside;
  const char* resonance = one ? "resonance near by" : "resonance outside the range";
  const auto decided = [&](Simulated simulated, std::string reason) {
    decision.simulated = simulated;
    decision.reason = std::move(reason);
    return decision;
  };
  if (!facts.has_contact) return decided(no, "a linear scene has one solution");
  if (!scene.response) return decided(no, "no [response] is asked for");
  if (in_time(scene)) return decided(no, "one motion is followed in time");
  if (facts.setting("coexistence") == "off") return decided(no, "effects.coexistence = \"off\"");
  if (scene.response->search_starts == 0) return decided(no, "response.search_starts = 0");
  if (asked_starts(scene) > 0) {
    return decided(yes, fmt::format("{} starts per frequency look for them", asked_starts(scene)));
  }
  if (facts.model == nullptr) return decided(undecided, later);
  if (!facts.reach) return decided(no, limits_alone);
  const bool leads_in = *decision.indicator > threshold;
  if (!leads_in && (one || facts.reach->nearby <= threshold)) {
    return decided(no, fmt::format("in the linear limits no {} {}", resonance, in_reach));
  }
  if (!leads_in) resonance = "resonance in the range";
  if (!one && is_short_search(scene, facts.both_directions, starts_of_a_search)) {
    decision.indicator = facts.reach->nearby;
    return decided(yes,
                   fmt::format("a {} {}: other solutions are looked for", resonance, in_reach));
  }
  const double seconds = seconds_of_search(facts);
  if (!leads_in) {
    return decided(no, fmt::format("a {} {}: folds of its curve are followed; branches that no "
                                   "sweep meets are not looked for, which would take some {:.2g} s",
                                   resonance, in_reach, seconds));
  }
  if (seconds > bearable_search) {
    return decided(
        no,
        fmt::format("not searched: a {} {}, so that there may be other solutions; a search would "
                    "take some {:.2g} s",
                    resonance, in_reach, seconds));
  }
  return decided(yes, fmt::format("a {} {}: other solutions are looked for", resonance, in_reach));
}

/// Of the modes that a scene of numbers gives, with what stands for omitted ones.
std::optional<double> residual_of_numbers(const EffectFacts& facts) {
  if (!std::holds_alternative<ModalModel>(facts.scene.model)) return std::nullopt;
  const SceneDescription with = with_effect(facts.scene, "residual");
  return residual_share(reduced_model(with), with);
}

/// What an effect that is given and left out would have for an indicator.
std::optional<double> indicator_left_out(std::string_view name, const EffectFacts& facts) {
  if (facts.model == nullptr) return std::nullopt;
  if (name == "centrifugal") return speed_size(facts, *as_written(facts.scene).rotation);
  if (name == "static_preload") return facts.model->static_variation;
  if (name == "residual") return residual_of_numbers(facts);
  if (!facts.has_range()) return std::nullopt;
  if (name == "moments") return tilt_size(*facts.model, facts.scene);
  if (!has_load(facts)) return std::nullopt;
  if (name == "roughness") return roughness_size(*facts.model, facts.scene);
  if (name == "rate_dependence") return friction_change(*facts.model, facts.scene);
  return std::nullopt;
}

EffectDecision without(const EffectLeftOut& effect, const EffectFacts& facts) {
  const bool chosen = facts.setting(effect.effect) == "auto";
  EffectDecision decision = by(
      false,
      chosen ? fmt::format("{} matters too little and is left out: {}", effect.key, effect.instead)
             : fmt::format("effects.{} = \"off\" leaves out {}: {}", effect.effect, effect.key,
                           effect.instead),
      indicator_left_out(effect.effect, facts));
  if (chosen) decision.threshold = limit_of(effect_row(effect.effect), facts.scene);
  return decision;
}

struct Chooser {
  std::string_view name;
  EffectDecision (*decide)(const EffectFacts&);
};

constexpr std::array choosers{
    Chooser{"nonlinearity", nonlinearity},
    Chooser{"normal_motion", normal_motion},
    Chooser{"separation", separation},
    Chooser{"mean_coupling", mean_coupling},
    Chooser{"second_direction", second_direction},
    Chooser{"higher_harmonics", higher_harmonics},
    Chooser{"roughness", roughness},
    Chooser{"rate_dependence", rate_dependence},
    Chooser{"moments", moments},
    Chooser{"residual", residual},
    Chooser{"local_frames", local_frames},
    Chooser{"static_preload", static_preload},
    Chooser{"centrifugal", centrifugal},
    Chooser{"stability", stability},
    Chooser{"wear", wear},
    Chooser{"maps", maps},
    Chooser{"coexistence", coexistence},
};
static_assert(std::ranges::equal(choosers, effect_table, {}, &Chooser::name, &EffectRow::name),
              "every row of the table of effects has its chooser, in the same order");

}  // namespace

EffectFacts effect_facts(const SceneDescription& scene, const ReducedModel* model,
                         const mesh::Mesh* mesh) {
  EffectFacts facts{.scene = scene, .model = model, .mesh = mesh};
  if (model != nullptr) {
    facts.reach = contact_reach(*model, scene);
    facts.motion_ratio = motion_ratio_along_r(*model, scene);
  }
  facts.both_directions = has_both_directions(scene, facts.motion_ratio);
  if (const auto* modal = std::get_if<ModalModel>(&scene.model)) {
    facts.has_contact = !modal->points.empty();
    facts.has_friction = std::ranges::any_of(modal->points, [](const auto& p) { return p.rubs(); });
    facts.has_normal_stiffness =
        std::ranges::any_of(modal->points, [](const auto& p) { return p.normal_stiffness > 0.0; });
  }
  for (const ContactDescription& contact : scene.contacts) {
    facts.has_contact = true;
    facts.has_friction = facts.has_friction || !contact.friction.is_zero();
    facts.has_normal_stiffness =
        facts.has_normal_stiffness || contact.normal_stiffness.value_or(1.0) > 0.0;
  }
  return facts;
}

bool can_be_along_r(const EffectFacts& facts) {
  const bool still = facts.model != nullptr && !can_rub_along_r(*facts.model);
  return facts.has_friction && can_move_along_r(facts.scene) && !still;
}

double least_motion_along_r(const SceneDescription& scene) {
  return scene.contacts.empty() ? least_given_motion : effect_row("second_direction").threshold;
}

bool in_time(const SceneDescription& scene) {
  return scene.response && scene.response->method == ResponseDescription::Method::time;
}

bool is_single_frequency(const SceneDescription& scene) {
  return scene.response->frequency_begin_hz == scene.response->frequency_end_hz;
}

EffectDecision decide(const EffectRow& row, const EffectFacts& facts) {
  const auto found = std::ranges::find(choosers, row.name, &Chooser::name);
  if (found == choosers.end()) throw std::out_of_range("no effect " + std::string(row.name));
  if (const EffectLeftOut* effect = left_out(facts.scene, row.name)) return without(*effect, facts);
  if (row.of_loads && facts.has_contact && is_linear_study(facts.scene))
    return cannot(limits_alone);
  return found->decide(facts);
}

double seconds_of_search(const EffectFacts& facts) {
  return search_seconds(facts.scene, curve_effects(facts.scene, facts.both_directions),
                        likely_starts(facts.scene, facts.both_directions));
}

std::string harmonics_text(const SceneDescription& scene) {
  if (!scene.response) return "no [response] is asked for";
  const HarmonicSettings& harmonics = scene.settings.harmonics;
  if (in_time(scene)) return "a motion integrated in time has all harmonics";
  if (harmonics.chosen()) {
    return fmt::format(
        "\"auto\": those beyond the first that change the highest peaks by more than {:.2g} %",
        percent * harmonics.tolerance);
  }
  if (harmonics.orders.empty()) return fmt::format("orders up to {} are kept", harmonics.highest);
  return fmt::format("the orders {} are kept", fmt::join(harmonics.orders, ", "));
}

int asked_starts(const SceneDescription& scene) {
  const bool on = setting_of(scene, "coexistence") == "on";
  return scene.response->search_starts.value_or(on ? starts_of_a_search : 0);
}

int likely_starts(const SceneDescription& scene, bool both_directions) {
  const int asked = asked_starts(scene);
  if (asked > 0) return asked;
  if (is_single_frequency(scene)) return starts_of_a_search;
  return is_short_search(scene, both_directions, starts_of_a_search) ? starts_of_a_search
                                                                     : starts_beside_a_curve;
}

int search_starts(const SceneDescription& scene, const ReducedModel& model, double load) {
  const int asked = asked_starts(scene);
  if (asked > 0 || model.patches.empty()) return asked;
  EffectFacts facts{.scene = scene, .model = &model};
  facts.has_contact = true;
  facts.both_directions = model.effects.second_direction;
  facts.reach = or_refused([&] { return contact_reach(model, scene, load); });
  return coexistence(facts).simulated == yes ? likely_starts(scene, model.effects.second_direction)
                                             : 0;
}

CurveEffects decided_curve_effects(const SceneDescription& scene, const ReducedModel& model) {
  CurveEffects effects = curve_effects(scene, model.effects.second_direction);
  effects.free_modes = static_cast<double>(model.frequency.size() - model.n_attachment);
  effects.normal_motion = model.effects.normal_motion;
  effects.mean = model.effects.mean_coupling;
  effects.linear_curves = n_linear_curves(model, scene);
  const auto is_searched = [&](const CurveRequest& request) {
    try {
      const auto asked = load_of(request, model);
      const auto* load = std::get_if<double>(&asked);
      return load != nullptr && search_starts(scene, model, *load) > 0;
    } catch (const RefusedError&) {  // refused where it is solved for
      return false;
    }
  };
  const std::vector<CurveRequest> requests = curve_requests(scene);
  effects.searched_share = static_cast<double>(std::ranges::count_if(requests, is_searched)) /
                           static_cast<double>(std::max<std::size_t>(requests.size(), 1));
  return effects;
}

}  // namespace microslip::pipelines
