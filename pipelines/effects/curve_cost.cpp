#include "pipelines/effects/curve_cost.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

#include "contact/contact_force.hpp"
#include "pipelines/description/curve_request.hpp"

namespace microslip::pipelines {
namespace {

constexpr double microsecond = 1e-6;

// Evaluations of the contact.
constexpr double of_a_curve = 600.0;
constexpr double of_a_choosing_curve = 1600.0;  // one with few harmonics, the choice, one with all
constexpr double of_one_frequency = 25.0;
constexpr double of_a_check = 30.0;  // of the peak, with eight harmonics more than were given
constexpr double of_a_start = 20.0;
constexpr double of_error_rows =
    250.0;  // of a curve: five richer models, one of four times the points
constexpr double curves_of_a_search = 30.0;  // for a best value, as many evaluations
constexpr double searches_of_a_bracket = 4.0;
constexpr double frequencies_of_a_search = 14.0;  // of a range (solver/curve/branch_search.hpp)

constexpr double points_of_a_curve = 95.0;
constexpr int harmonics_of_a_choice = 7;       // about, where contact slips
constexpr double period_map = 2e-3;            // of a point of a curve in scenes of few states
constexpr double states_of_a_period_map = 16;  // at most (solver/stability/stability.hpp)
constexpr double factorisation = 6e-11;        // over the cube of the unknowns

// A motion integrated in time, until it is periodic.
constexpr double periods_from_rest = 250.0;
constexpr double periods_of_a_step = 100.0;  // to the next frequency
constexpr double point_period = 0.9e-3;      // one contact point, one period

struct Size {
  double points = 0.0;
  double modes = 0.0;
  int harmonics = 1;
};

Size size_of(const SceneDescription& scene, const CurveEffects& effects) {
  constexpr double attachment_shapes = 4.0;  // of a patch, about
  Size size;
  if (const auto* modal = std::get_if<ModalModel>(&scene.model)) {
    size.points = static_cast<double>(modal->points.size());
    size.modes = static_cast<double>(modal->frequency_hz.size());
  } else {
    size.modes = scene.settings.basis.n_modes + attachment_shapes;
  }
  for (std::size_t i = 0; i < scene.settings.patches.size(); ++i) {
    size.points += contact_points(scene.settings, i);
  }
  const HarmonicSettings& given = scene.settings.harmonics;
  const int n_given = given.orders.empty() ? given.highest : static_cast<int>(given.orders.size());
  const bool chosen = effects.chosen_harmonics || (effects.several_harmonics && n_given == 1);
  size.harmonics = chosen ? harmonics_of_a_choice : effects.several_harmonics ? n_given : 1;
  return size;
}

/// Force and Jacobian of one point, with its share of the step,
/// by the method that contact would choose.
double point_seconds(const SceneDescription& scene, const CurveEffects& effects, const Size& size) {
  const bool rough = is_rough(scene);
  const bool plain = !effects.second_direction && !rough && !is_rate_dependent(scene);
  const double more = size.harmonics - 1;  // harmonics
  switch (contact::method_for(std::llround(size.points), plain, size.harmonics)) {
    case contact::Method::closed_form:
      return 1.0 * microsecond;
    case contact::Method::lanes:
      return (plain ? 7.0 + 0.9 * more : (rough ? 40.0 : 30.0) + 1.5 * more) * microsecond;
    case contact::Method::point_methods:
      break;
  }
  if (plain) return (2.0 + 1.5 * more + 0.17 * more * more) * microsecond;
  if (!effects.second_direction) return 17.0 * (1.0 + 0.7 * more) * microsecond;
  return (rough ? 250.0 : 140.0) * size.harmonics * microsecond;
}

double evaluation_seconds(const SceneDescription& scene, const CurveEffects& effects,
                          const Size& size) {
  const double unknowns = size.modes * (2.0 * size.harmonics + 1.0);
  return size.points * point_seconds(scene, effects, size) +
         factorisation * unknowns * unknowns * unknowns;
}

/// Of one point of a curve, where the multipliers of its period are looked at.
double stability_seconds(const CurveEffects& effects, const Size& size) {
  const bool in_time = size.harmonics > 1 && !effects.second_direction &&
                       2.0 * size.modes + size.points <= states_of_a_period_map;
  return in_time ? period_map : 0.0;
}

bool is_one_frequency(const SceneDescription& scene) {
  return scene.response->frequency_begin_hz == scene.response->frequency_end_hz;
}

/// Those that are no linear limit.
double n_curves(const SceneDescription& scene) {
  return static_cast<double>(std::ranges::count_if(
      curve_requests(scene),
      [](const CurveRequest& one) { return !std::holds_alternative<LimitName>(one.load); }));
}

/// Of the harmonics of one curve (response_stage.hpp).
double check_seconds(const SceneDescription& scene, CurveEffects effects, Size size) {
  const HarmonicSettings& given = scene.settings.harmonics;
  if (given.chosen() || !given.checked || size.points == 0.0) return 0.0;
  size.harmonics = given.highest + harmonics_of_a_check;
  effects.several_harmonics = true;
  return of_a_check * evaluation_seconds(scene, effects, size);
}

double seconds_in_time(const SceneDescription& scene, const Size& size) {
  const double steps = is_one_frequency(scene) ? 0.0 : scene.response->n_time_points - 1;
  return n_curves(scene) * std::max(size.points, 1.0) * point_period *
         (periods_from_rest + steps * periods_of_a_step);
}

}  // namespace

CurveEffects curve_effects(const SceneDescription& scene, bool second_direction) {
  const HarmonicSettings& harmonics = scene.settings.harmonics;
  return {second_direction, harmonics.highest > 1, harmonics.chosen()};
}

ResponseSeconds response_seconds(const SceneDescription& scene, const CurveEffects& effects) {
  const Size size = size_of(scene, effects);
  const double evaluation = evaluation_seconds(scene, effects, size);
  const double stability = stability_seconds(effects, size);
  const bool one = is_one_frequency(scene);
  ResponseSeconds seconds;
  if (scene.response->method == ResponseDescription::Method::time) {
    seconds.curves = seconds_in_time(scene, size);
  } else {
    const double evaluations = one                        ? of_one_frequency
                               : effects.chosen_harmonics ? of_a_choosing_curve
                                                          : of_a_curve;
    seconds.curves =
        n_curves(scene) * (evaluations * evaluation + (one ? 1.0 : points_of_a_curve) * stability +
                           check_seconds(scene, effects, size));
    const bool told = scene.accuracy.error_budget && !scene.contacts.empty();
    if (told) seconds.errors = n_curves(scene) * of_error_rows * evaluation;
  }
  if (scene.response->optimum) {
    constexpr double stable_curves =
        10.0;  // about: peaks alone are judged, and the curves of its error
    seconds.best_value = curves_of_a_search * of_a_curve * evaluation +
                         stable_curves * points_of_a_curve * stability;
    seconds.bracket = searches_of_a_bracket * seconds.best_value;
  }
  return seconds;
}

double search_seconds(const SceneDescription& scene, const CurveEffects& effects, int n_starts) {
  const double frequencies = is_one_frequency(scene) ? 1.0 : frequencies_of_a_search;
  const Size size = size_of(scene, effects);
  return n_curves(scene) * frequencies * n_starts * of_a_start *
         evaluation_seconds(scene, effects, size);
}

}  // namespace microslip::pipelines
