#include "pipelines/response/solver_scenes.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "contact/phase.hpp"
#include "pipelines/effects/contact_effects.hpp"
#include "pipelines/effects/effect_choice.hpp"
#include "pipelines/model/slow_attachment.hpp"
#include "pipelines/system/deadline.hpp"
#include "pipelines/system/interrupt.hpp"

namespace microslip::pipelines {
namespace {

// Of the balance where forces are sampled: they err by 1e-5, and kinks between instants make the
// last digits dear.
constexpr double sampled_tolerance = 1e-9;

contact::Harmonics excitation(const ReducedModel& model, int n_harmonics) {
  contact::Harmonics force(n_harmonics, model.frequency.size());
  force.rows().row(0) = model.force_static;
  force.rows().row(1) = model.force_sine;
  force.rows().row(2) = model.force_cosine;
  return force;
}

std::unique_ptr<contact::TransientForce> transient_force(const ReducedModel& model, double load) {
  return model.patches.empty() ? nullptr : contact_of(model, load).transient_force();
}

/// The highest harmonic that a mode of the structure may answer in the range.
int order_of_modes(const ReducedModel& model, const ResponseDescription& response, int most) {
  const Eigen::Index n_free = model.frequency.size() - model.n_attachment;
  const double top = n_free > 0 ? model.frequency.head(n_free).maxCoeff() : 0.0;
  const double lowest =
      contact::two_pi * std::min(response.frequency_begin_hz, response.frequency_end_hz);
  return static_cast<int>(std::min(std::floor(top / lowest), static_cast<double>(most)));
}

/// Chosen harmonics end where the modes do: beyond, a harmonic meets resonances of attachment
/// shapes, which no structure has. The first nine are always meant:
/// attachment shapes answer them like springs.
int most_meant(const ReducedModel& model, const ResponseDescription& response, int highest) {
  if (model.n_attachment == 0) return highest;
  constexpr int least = 9;
  return std::clamp(order_of_modes(model, response, highest), std::min(least, highest), highest);
}

bool has_constant_load(const contact::Patch& patch, const ContactEffects& effects) {
  return !effects.normal_motion || patch.cells.shapes.v.isZero(0.0) ||
         patch.cells.stiffness.col(1).isZero(0.0);
}

/// Forces of contact change sign with the motion, and the excitation half a period later: so does
/// the motion (theory 13).
bool has_odd_motions(const ReducedModel& model) {
  return model.force_static.isZero(0.0) &&
         std::ranges::all_of(model.patches, [&](const contact::Patch& patch) {
           return patch.rules.plain() && has_constant_load(patch, model.effects);
         });
}

/// With the highest, so that tables have the columns that are asked for.
std::vector<int> odd_orders(int highest) {
  std::vector<int> orders;
  for (int k = 1; k < highest; k += 2) orders.push_back(k);
  orders.push_back(highest);
  return orders;
}

}  // namespace

solver::Scene solver_scene(const ReducedModel& model, double load) {
  solver::Scene scene;
  scene.natural_frequency = model.frequency;
  scene.damping_ratio = model.damping_ratio;
  scene.excitation = excitation(model, model.effects.n_harmonics);
  scene.output = model.output;
  if (!model.patches.empty()) scene.contact = contact_of(model, load).modal_force();
  return scene;
}

solver::Scene limit_scene(ReducedModel model) {
  model.coordinates = {};
  for (contact::Patch& patch : model.patches) {
    patch.tilted_areas.clear();
    patch.rules.roughness.reset();
  }
  return solver_scene(model, 1.0);
}

solver::Scene balanced_scene(const ReducedModel& model, double load,
                             const solver::ContinuationOptions& options) {
  solver::Scene problem = solver_scene(model, load);
  // A period map moves the mean as well.
  const bool maps_period = options.n_harmonics > 1 && model.effects.mean_coupling;
  if (maps_period) problem.transient = transient_force(model, load);
  return problem;
}

solver::ContinuationOptions with_search_scene(solver::ContinuationOptions options,
                                              const ReducedModel& model, double load) {
  const bool dear =
      model.effects.second_direction && !contact::is_sampled(model.patches, model.effects);
  if (!dear || options.search_starts == 0) return options;
  ReducedModel sampled = model;
  sampled.effects.sampled = true;
  options.search_scene = std::make_shared<solver::Scene>(solver_scene(sampled, load));
  return options;
}

Eigen::VectorXd slowing_of(const ReducedModel& model, const ResponseDescription& response) {
  return slowing(
      model, contact::two_pi * std::max(response.frequency_begin_hz, response.frequency_end_hz));
}

/// Explicit steps need not follow attachment shapes, see slow_attachment.hpp.
solver::Scene integrated_scene(const ReducedModel& model, const ResponseDescription& response,
                               double load) {
  const ReducedModel slow = slowed(model, slowing_of(model, response));
  solver::Scene problem = solver_scene(slow, load);
  problem.transient = transient_force(slow, load);
  return problem;
}

solver::ContinuationOptions continuation_options(const SceneDescription& scene,
                                                 const ReducedModel& model) {
  const ResponseDescription& response = *scene.response;
  const HarmonicSettings& harmonics = scene.settings.harmonics;
  solver::ContinuationOptions options;
  options.frequency_begin = contact::two_pi * response.frequency_begin_hz;
  options.frequency_end = contact::two_pi * response.frequency_end_hz;
  options.n_harmonics =
      harmonics.chosen() ? most_meant(model, response, harmonics.highest) : harmonics.highest;
  constexpr int highest_asked = 100;  // whether it resonates: a line of a force each
  options.highest_resonance = order_of_modes(model, response, highest_asked);
  options.orders = harmonics.orders;
  const bool given = options.orders.empty() && !harmonics.chosen();
  if (given && has_odd_motions(model)) {
    options.orders = odd_orders(harmonics.highest);
    options.without_mean = true;
  }
  options.harmonic_tolerance = harmonics.tolerance;
  options.search_starts = asked_starts(scene);
  options.judge_stability = scene.judges_stability;
  options.linear_certificate = setting_of(scene, "nonlinearity") != "on";
  options.stop = [] { return interrupt_requested() || cut_short(); };
  if (contact::is_sampled(model.patches, model.effects)) {
    options.residual_tolerance = sampled_tolerance;
    options.corrector = solver::ContinuationOptions::Corrector::few_jacobians;
  }
  return options;
}

}  // namespace microslip::pipelines
