#include "pipelines/model/contact_effects.hpp"

#include <algorithm>
#include <limits>
#include <string>

#include <fmt/format.h>

#include "pipelines/model/motion_along_r.hpp"

namespace microslip::pipelines {
namespace {

void require_stiffness_along_r(const ReducedModel& model) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const contact::Patch& patch : model.patches) {
    const double here = patch.cells.stiffness.col(2).minCoeff();
    if (!(here >= smallest)) smallest = here;  // NaN too
  }
  if (smallest >= 0.0) return;
  throw RefusedError(fmt::format(
      "residual flexibility makes the contact stiffness along r not positive (smallest {:.3g} "
      "N/m^3): "
      "give a finite local stiffness and modes.residual = \"attachment\", or more modes",
      smallest));
}

}  // namespace

ContactEffects contact_effects(const ReducedModel& model, const SceneDescription& scene) {
  ContactEffects effects;
  effects.n_harmonics = scene.settings.harmonics.highest;
  if (scene.response && scene.response->method == ResponseDescription::Method::time) {
    effects.n_harmonics = std::max(effects.n_harmonics, least_harmonics_of_time);
  }
  effects.normal_motion = setting_of(scene, "normal_motion") != "off";
  using enum Discretisation::Choice;
  const Discretisation::Choice choice = scene.settings.second_direction;
  effects.motion_ratio = motion_ratio_along_r(model, scene);
  // Motion of given modes along r is meant, unless it is rounding.
  const bool meshed = !scene.contacts.empty();
  const bool called_for = effects.motion_ratio > (meshed ? negligible_motion_along_r : 1e-9);
  effects.second_direction =
      choice == on || (choice == automatic && called_for && !model.patches.empty());
  if (effects.second_direction) require_stiffness_along_r(model);
  return effects;
}

contact::ContactForce contact_of(const ReducedModel& model, double load) {
  return or_refused([&] { return contact::ContactForce(model.patches, model.effects, load); });
}

}  // namespace microslip::pipelines
