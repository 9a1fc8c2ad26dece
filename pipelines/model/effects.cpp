#include "pipelines/model/effects.hpp"

#include <algorithm>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace microslip::pipelines {
namespace {

/// What the scene's numbers say about its contact.
struct ContactFacts {
  bool has_contact = false;
  bool has_friction = false;
  bool has_normal_stiffness = false;
};

ContactFacts facts_of(const SceneDescription& scene) {
  ContactFacts facts;
  if (const auto* modal = std::get_if<ModalModel>(&scene.model)) {
    facts.has_contact = !modal->points.empty();
    facts.has_friction = std::any_of(modal->points.begin(), modal->points.end(), [](const auto& p) {
      return p.friction_coefficient > 0.0 && p.tangential_stiffness > 0.0;
    });
    facts.has_normal_stiffness =
        std::any_of(modal->points.begin(), modal->points.end(),
                    [](const auto& p) { return p.normal_stiffness > 0.0; });
  }
  for (const ContactDescription& contact : scene.contacts) {
    facts.has_contact = true;
    facts.has_friction = facts.has_friction || !contact.friction.is_zero();
    facts.has_normal_stiffness =
        facts.has_normal_stiffness || contact.normal_stiffness.value_or(1.0) > 0.0;
  }
  return facts;
}

void add_second_direction(const SceneDescription& scene, const ReducedModel* model,
                          std::vector<EffectRecord>& effects) {
  using enum Discretisation::Choice;
  const Discretisation::Choice choice = scene.settings.second_direction;
  const bool simulated = model != nullptr ? model->effects.second_direction : choice == on;
  std::string reason;
  if (choice != automatic) {
    reason = "asked for in the scene";
  } else if (model == nullptr) {
    reason = "decided when the modes are known: friction along r where the patch moves along r";
  } else {
    reason = fmt::format("motion along r is {:.2g} % of that along p in the linear limits",
                         100.0 * model->effects.motion_ratio);
  }
  const char* setting = choice == on ? "on" : choice == off ? "off" : "auto";
  effects.push_back({"second_direction", setting, simulated, reason});
}

/// By a force that varies in time.
bool is_excited(const SceneDescription& scene) {
  if (const auto* modal = std::get_if<ModalModel>(&scene.model)) {
    return modal->force_sine.cwiseAbs().maxCoeff() > 0.0 ||
           modal->force_cosine.cwiseAbs().maxCoeff() > 0.0;
  }
  return std::ranges::any_of(scene.forces,
                             [](const ForceDescription& force) { return force.amplitude != 0.0; });
}

/// A mode that vibrates without damping.
bool is_undamped(const SceneDescription& scene) {
  if (const auto* modal = std::get_if<ModalModel>(&scene.model))
    return ((modal->damping_ratio.array() == 0.0) && (modal->frequency_hz.array() > 0.0)).any();
  if (const auto* rayleigh = std::get_if<RayleighDamping>(&scene.modes.damping)) {
    return rayleigh->alpha == 0.0 && rayleigh->beta == 0.0;
  }
  const auto& ratios = std::get<std::vector<double>>(scene.modes.damping);
  return std::ranges::find(ratios, 0.0) != ratios.end();
}

}  // namespace

std::string harmonics_text(const SceneDescription& scene) {
  if (!scene.response) return "";
  const HarmonicSettings& harmonics = scene.settings.harmonics;
  if (scene.response->method == ResponseDescription::Method::time) {
    return "a motion integrated in time has all harmonics";
  }
  if (harmonics.chosen()) {
    return fmt::format(
        "response.harmonics = \"auto\": those beyond the first that change the highest peaks by "
        "more than "
        "{:.2g} %",
        100.0 * harmonics.tolerance);
  }
  if (harmonics.orders.empty()) {
    return fmt::format("response.harmonics = {}", harmonics.highest);
  }
  return fmt::format("response.harmonics = [{}]", fmt::join(harmonics.orders, ", "));
}

std::vector<EffectRecord> effects_of(const SceneDescription& scene, const ReducedModel* model) {
  const ContactFacts facts = facts_of(scene);
  const bool modal = std::holds_alternative<ModalModel>(scene.model);
  const ResidualKind residual = scene.settings.basis.residual;
  const bool left_out = setting_of(scene, "normal_motion") == "off";
  const bool normal = facts.has_normal_stiffness && !left_out;
  const std::string constant_load =
      left_out ? "effects.normal_motion = \"off\": the load stays that of rest"
               : "no normal stiffness: the load is constant";
  std::vector<EffectRecord> effects;
  const auto add = [&](const char* name, bool simulated, const std::string& why,
                       const std::string& why_not) {
    effects.push_back({name, setting_of(scene, name), simulated, simulated ? why : why_not});
  };
  add("friction", facts.has_friction, "friction coefficient and tangential stiffness are positive",
      facts.has_contact ? "no point has friction" : "the scene has no contact");
  add("normal_motion", normal,
      "the contact has normal stiffness: its load varies with the approach", constant_load);
  add("separation", normal, "the contact is one-sided", constant_load);
  add("mean_coupling", normal, "the mean approach changes the load", constant_load);
  add("residual", facts.has_contact && residual != ResidualKind::none,
      residual == ResidualKind::attachment
          ? "static shapes of the contact and of the forces stand for omitted modes"
          : "flexibility of the omitted modes stands in series with the contact stiffness",
      !modal ? "modes.residual = \"none\", or no contact" : "the given stiffness is used as it is");
  const bool several = scene.settings.harmonics.highest > 1;
  add("stability", facts.has_contact,
      several ? "Hill's exponents of every point with several harmonics, where they can tell; in "
                "scenes of few "
                "modes and points the multipliers of a period in time"
              : "slow-flow eigenvalues of every point",
      "a linear scene is stable");
  add_second_direction(scene, model, effects);
  add("higher_harmonics", scene.settings.harmonics.highest > 1, harmonics_text(scene),
      harmonics_text(scene));
  add("roughness", is_rough(scene), "the surfaces are rough", "no roughness is given");
  add("rate_dependence", is_rate_dependent(scene),
      "the friction coefficient follows the slip speed", "the friction coefficient is constant");
  return effects;
}

std::vector<std::string> scene_warnings(const SceneDescription& scene) {
  std::vector<std::string> warnings;
  for (const contact::SurfaceRules& rules : surface_rules(scene)) {
    const auto& law = rules.friction;
    if (!law) continue;
    constexpr double fast = 1e300;  // [m/s]: the law at any speed there is
    const double kinetic = law->at(fast).value;
    if (kinetic > law->at_rest()) {
      warnings.push_back(
          fmt::format("friction law: the kinetic coefficient {:g} is above the static {:g}: "
                      "friction grows with the slip speed; "
                      "are the two exchanged?",
                      kinetic, law->at_rest()));
    }
  }
  if (!scene.response) return warnings;
  if (!is_excited(scene))
    warnings.emplace_back("no force excites the structure: its response will be zero");
  if (is_undamped(scene)) {
    warnings.emplace_back(
        "a mode has no damping: where friction takes no energy, as in the free and the stuck "
        "limit, its peak may "
        "have no end, and the curve be incomplete then");
  }
  const auto [low, high] =
      std::minmax(scene.response->frequency_begin_hz, scene.response->frequency_end_hz);
  for (const MapEntry& entry : scene.response->maps) {
    const auto* frequency = std::get_if<double>(&entry);
    if (frequency == nullptr || (*frequency >= low && *frequency <= high)) continue;
    warnings.push_back(fmt::format(
        "response.maps: {:g} Hz lies outside the range {:g} to {:g} Hz: there will be no map of it",
        *frequency, low, high));
  }
  return warnings;
}

}  // namespace microslip::pipelines
