#include "pipelines/effects/contact_effects.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include "pipelines/description/curve_request.hpp"
#include "pipelines/effects/effects.hpp"

namespace microslip::pipelines {
namespace {

void require_stiffness_along_r(const ReducedModel& model, const SceneDescription& scene) {
  for (std::size_t i = 0; i < model.patches.size(); ++i) {
    const double smallest = model.patches[i].cells.stiffness.col(2).minCoeff();
    if (smallest >= 0.0) continue;
    throw RefusedError(fmt::format(
        "{}residual flexibility makes the contact stiffness along r not positive (smallest {:.3g} "
        "N/m^3): give a finite local stiffness and modes.residual = \"attachment\", or more modes",
        i < scene.contacts.size() ? scene.contacts[i].place + ": " : "", smallest));
  }
}

void require_obeyed(const std::vector<EffectRecord>& chosen, const SceneDescription& scene) {
  for (const EffectRecord& effect : chosen) {
    if (effect.refusal.empty()) continue;
    throw RefusedError(fmt::format("{} = \"{}\": {}", place_in(scene, "effects." + effect.name),
                                   effect.setting, effect.refusal));
  }
}

}  // namespace

ContactEffects contact_effects(const ReducedModel& model, const SceneDescription& scene) {
  ContactEffects effects;
  effects.n_harmonics = scene.settings.harmonics.highest;
  if (scene.response && scene.response->method == ResponseDescription::Method::time) {
    effects.n_harmonics = std::max(effects.n_harmonics, least_harmonics_of_time);
  }
  effects.force_tolerance = scene.settings.tolerance_of_forces();
  const std::vector<EffectRecord> chosen = effects_of(scene, &model);
  require_obeyed(chosen, scene);
  const EffectRecord& along_r = effect_in(chosen, "second_direction");
  effects.normal_motion = effect_in(chosen, "normal_motion").simulated != Simulated::no;
  effects.mean_coupling =  // of the limits alone nothing is left out
      !effects.normal_motion || is_linear_study(scene) ||
      effect_in(chosen, "mean_coupling").simulated != Simulated::no;
  effects.motion_ratio = along_r.indicator.value_or(0.0);
  effects.second_direction = along_r.simulated == Simulated::yes && !model.patches.empty();
  if (effects.second_direction) require_stiffness_along_r(model, scene);
  return effects;
}

contact::ContactForce contact_of(const ReducedModel& model, double load) {
  return or_refused(
      [&] { return contact::ContactForce(model.patches, model.effects, load, model.coordinates); });
}

}  // namespace microslip::pipelines
