#include "pipelines/effects/curve_cost.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <variant>
#include <vector>

#include "contact/contact_force.hpp"
#include "pipelines/description/curve_request.hpp"
#include "pipelines/description/effects_left_out.hpp"
#include "pipelines/effects/effect_choice.hpp"
#include "pipelines/system/machine_speed.hpp"
#include "solver/time_options.hpp"

namespace microslip::pipelines {
namespace {

constexpr double microsecond = 1e-6;

// Evaluations of the contact.
constexpr double of_a_curve = 600.0;
constexpr double of_a_choosing_curve = 1600.0;  // one with few harmonics, the choice, one with all
// Times as many where several points open and close at instants of their own, events located.
constexpr double of_many_events = 3.2;
// The same of a mesh whose contact is one point, which opens with all of its load.
constexpr double of_one_point_that_opens = 4.0;
// An effect put back at the peaks of a curve: of a mesh, with a peak or two; of numbers.
constexpr double of_an_effect_on_a_mesh = 60.0;
// Times that, for friction along r: the peak and points along the curve are solved for in a plane.
// Measured on the plates of share/scenes.
constexpr double of_the_second_direction_on_a_mesh = 40.0;
constexpr double of_an_effect = 600.0;
constexpr double of_one_frequency = 25.0;
constexpr double of_a_check = 30.0;  // of the peak, with eight harmonics more than were given
constexpr double of_a_start = 20.0;  // at a single frequency
constexpr double of_a_start_beside_a_curve = 60.0;
// Of a curve: five richer models, one of four times the points.
constexpr double of_error_rows = 450.0;
// Peaks have more harmonics than their curves; with a tolerance steps tell what is a small part.
constexpr double of_error_rows_of_chosen = 1500.0;
constexpr double of_error_rows_to_a_tolerance = 700.0;
constexpr double rows_of_a_linear_curve = 0.2;  // of others: no point is awake
// Of a search for a best value; of one that may end sooner, with its error.
constexpr double of_a_search = 18'000.0;
constexpr double of_a_short_search = 12'000.0;
// The error of the former, in searches, and what more harmonics would change: richer curves.
constexpr double searches_of_its_error = 0.5;
constexpr double richer_curves_of_a_search = 5.0;
constexpr double searches_of_a_bracket = 4.0;
constexpr double frequencies_of_a_search = 14.0;  // of a range (solver/curve/branch_search.hpp)

constexpr double points_of_a_curve = 95.0;
// About, to one per cent, where contact slips; so many more to less.
constexpr double harmonics_of_a_choice = 7.0;
constexpr double harmonics_of_a_choice_on_a_mesh = 12.0;
constexpr double usual_choice = 0.01;
constexpr double more_harmonics = 0.6;         // exponent
constexpr double period_map = 2.2e-4;          // of a point in scenes of few states, over harmonics
constexpr double states_of_a_period_map = 16;  // at most (solver/stability/stability.hpp)
// As many times where loads vary, so that instants of slip and opening are looked for.
constexpr double of_events_in_a_period = 2.5;
constexpr double of_many_events_in_a_period = 10.0;  // of several points
constexpr double factorisation = 6e-11;              // over the cube of the unknowns
// Of evaluations that are cheap without derivatives; of many unknowns they are quicker and fewer.
constexpr double few_factorisations = 0.5;
constexpr double many_unknowns = 80.0;
// Hill's exponents of a point, over the cube of the unknowns up to where states are condensed; a
// part of what evaluations take.
constexpr double hill = 2e-10;
constexpr double hill_of_many = 4e-3;

// A motion integrated in time, until it is periodic.
constexpr double decays_from_rest = 2.6;  // periods times damping ratio: a chain from 0.1 to 2 %
constexpr double decays_of_a_step = 1.3;  // to the next frequency
constexpr double most_beside_a_resonance = 250.0;  // at one frequency, where friction damps
constexpr double point_period = 0.65e-3;           // one contact point, one period
constexpr double points_of_a_step = 32.0;          // so many more, and steps are twice as many

struct Size {
  double points = 0.0;
  double modes = 0.0;
  int harmonics = 1;
};

/// Shapes that stand for omitted modes, of a scene that has or had them.
double n_shapes(const SceneDescription& scene) {
  constexpr double of_a_patch = 4.0;  // about
  const SceneDescription& written = as_written(scene);
  if (const auto* modal = std::get_if<ModalModel>(&written.model)) {
    return static_cast<double>(modal->n_attachment);
  }
  return written.settings.basis.residual == ResidualKind::attachment ? of_a_patch : 0.0;
}

double n_free_modes(const SceneDescription& scene) {
  const auto* modal = std::get_if<ModalModel>(&scene.model);
  const BasisSettings& basis = scene.settings.basis;
  constexpr double as_reach = 2.0;  // times those asked for, about
  if (modal == nullptr) return basis.n_modes * (basis.reach > 0.0 ? as_reach : 1.0);
  return static_cast<double>(modal->frequency_hz.size() - modal->n_attachment);
}

/// @param areas  else each is one point.
double n_points(const SceneDescription& scene, bool areas) {
  if (const auto* modal = std::get_if<ModalModel>(&scene.model)) {
    const bool lumped = !areas && modal->positions.rows() > 1;
    return lumped ? 1.0 : static_cast<double>(modal->points.size());
  }
  double n = 0.0;
  for (std::size_t i = 0; i < scene.settings.patches.size(); ++i) {
    n += areas ? contact_points(scene.settings, i) : 1;
  }
  return n;
}

/// In a scene of numbers.
bool has_varying_loads(const SceneDescription& scene, const CurveEffects& effects) {
  const auto* modal = std::get_if<ModalModel>(&scene.model);
  if (modal == nullptr || modal->shapes.v.isZero(0.0)) return false;
  return effects.normal_motion && std::ranges::any_of(modal->points, [](const auto& point) {
           return point.normal_stiffness > 0.0;
         });
}

/// Even harmonics are no unknowns then (continuation_options()).
bool has_odd_motions(const SceneDescription& scene, const CurveEffects& effects) {
  const auto* modal = std::get_if<ModalModel>(&scene.model);
  if (effects.roughness || effects.rate_dependence) return false;
  if (modal == nullptr) {
    return !effects.normal_motion && !scene.rotation && scene.static_loads.place.empty();
  }
  if (modal->force_static.size() > 0 && !modal->force_static.isZero(0.0)) return false;
  return !has_varying_loads(scene, effects);
}

int n_chosen(const SceneDescription& scene) {
  const HarmonicSettings& given = scene.settings.harmonics;
  const double n = scene.contacts.empty() ? harmonics_of_a_choice : harmonics_of_a_choice_on_a_mesh;
  if (!given.chosen()) return static_cast<int>(n);
  const double closer = std::pow(usual_choice / given.tolerance, more_harmonics);
  return static_cast<int>(std::lround(std::clamp(n * closer, 1.0, 1.0 * given.highest)));
}

Size size_of(const SceneDescription& scene, const CurveEffects& effects) {
  Size size;
  size.points = n_points(scene, effects.areas);
  size.modes =
      effects.free_modes.value_or(n_free_modes(scene)) + (effects.residual ? n_shapes(scene) : 0.0);
  const HarmonicSettings& given = scene.settings.harmonics;
  int n_given = given.orders.empty() ? given.highest : static_cast<int>(given.orders.size());
  const bool chosen = effects.chosen_harmonics || (effects.several_harmonics && n_given == 1);
  if (given.orders.empty() && has_odd_motions(scene, effects)) n_given = (n_given + 1) / 2;
  size.harmonics = chosen ? n_chosen(scene) : effects.several_harmonics ? n_given : 1;
  return size;
}

bool is_plain(const CurveEffects& effects) {
  return !effects.second_direction && !effects.roughness && !effects.rate_dependence;
}

/// As contact would choose.
contact::Method method_of(const CurveEffects& effects, const Size& size) {
  return contact::method_for(std::llround(size.points), is_plain(effects), size.harmonics);
}

/// Force and Jacobian of one point, with its share of the step.
double point_seconds(const CurveEffects& effects, const Size& size) {
  const bool rough = effects.roughness;
  const bool plain = is_plain(effects);
  const double more = size.harmonics - 1;  // harmonics
  const double square = size.harmonics * size.harmonics;
  const double both = rough && effects.rate_dependence ? 2.0 : 1.0;
  const double in_plane =
      effects.second_direction && (rough || effects.rate_dependence) ? 1.9 : 1.0;
  switch (method_of(effects, size)) {
    case contact::Method::closed_form:
      return 1.0 * microsecond;
    case contact::Method::lanes:
      return (rough ? 1.6 : 1.0) * (plain ? 0.5 + 0.1 * square : in_plane * (4.0 + 0.3 * square)) *
             microsecond;
    case contact::Method::point_methods:
      break;
  }
  if (plain) return (2.0 + 1.5 * more + 0.17 * more * more) * microsecond;
  if (!effects.second_direction) return 17.0 * both * (1.0 + 0.7 * more) * microsecond;
  const double surface = (rough ? 1.4 : 1.0) * (effects.rate_dependence ? 0.8 : 1.0);
  return 130.0 * surface * (1.0 + 0.13 * more) * microsecond;
}

/// Of several points whose loads vary; those of a mesh are many, and have no events located.
bool has_many_events(const SceneDescription& scene, const CurveEffects& effects, const Size& size) {
  if (size.points < 2.0 || !has_varying_loads(scene, effects)) return false;
  const auto n = std::llround(size.points);
  return contact::method_for(n, false, size.harmonics) == contact::Method::point_methods;
}

bool opens_at_once(const SceneDescription& scene, const CurveEffects& effects) {
  return !scene.contacts.empty() && !effects.areas && effects.normal_motion;
}

/// Many modes are seen by a contact through fewer coordinates, by few points through three each.
double n_unknowns(const CurveEffects& effects, const Size& size) {
  constexpr double most_coordinates = 40.0;  // about
  const double coordinates = std::min({size.modes, most_coordinates, 3.0 * size.points});
  return coordinates * (2.0 * size.harmonics + (effects.mean ? 1.0 : 0.0));
}

double evaluation_seconds(const CurveEffects& effects, const Size& size) {
  const bool sampled = method_of(effects, size) == contact::Method::lanes;
  const double n = n_unknowns(effects, size);
  const double balance =
      sampled ? few_factorisations * n * n * std::min(n, many_unknowns) : n * n * n;
  return size.points * point_seconds(effects, size) + factorisation * balance;
}

/// Of one point of a curve, beside its evaluations: where the multipliers of its period are looked
/// at. Below 0 where it is not judged, and evaluations are said to take more than they do.
double stability_seconds(const SceneDescription& scene, const CurveEffects& effects,
                         const Size& size) {
  if (size.harmonics == 1) return 0.0;
  const bool in_time =
      !effects.second_direction && 2.0 * size.modes + size.points <= states_of_a_period_map;
  const double events = has_many_events(scene, effects, size) ? of_many_events_in_a_period
                        : has_varying_loads(scene, effects)   ? of_events_in_a_period
                                                              : 1.0;
  if (in_time) return effects.stability ? events * size.harmonics * period_map : 0.0;
  return effects.stability ? 0.0
                           : -std::min(hill * std::pow(n_unknowns(effects, size), 3), hill_of_many);
}

/// Those that are no linear limit.
double n_curves(const SceneDescription& scene) {
  return static_cast<double>(std::ranges::count_if(curve_requests(scene), is_loaded));
}

/// Of the harmonics of one curve (harmonics_check.hpp).
double check_seconds(const SceneDescription& scene, CurveEffects effects, Size size) {
  const HarmonicSettings& given = scene.settings.harmonics;
  const bool is_asked = given.checked && scene.accuracy.error_budget;
  if (given.chosen() || !is_asked || size.points == 0.0) return 0.0;
  size.harmonics = given.highest + harmonics_of_a_check;
  effects.several_harmonics = true;
  return of_a_check * evaluation_seconds(effects, size);
}

/// The least of all modes, as a mode decays in a period of the excitation; 0: not known.
double least_decay(const SceneDescription& scene) {
  if (const auto* modal = std::get_if<ModalModel>(&scene.model)) {
    const double middle =
        0.5 * (scene.response->frequency_begin_hz + scene.response->frequency_end_hz);
    const Eigen::Index n = modal->frequency_hz.size() - modal->n_attachment;
    const Eigen::ArrayXd decay =
        modal->damping_ratio.head(n).array() * modal->frequency_hz.head(n).array() / middle;
    return n > 0 ? decay.minCoeff() : 0.0;
  }
  const auto* ratios = std::get_if<std::vector<double>>(&scene.modes.damping);
  return ratios != nullptr && !ratios->empty() ? std::ranges::min(*ratios) : 0.0;
}

double seconds_in_time(const SceneDescription& scene, const Size& size) {
  const double decay = least_decay(scene);
  const double most_periods = solver::TimeOptions{}.max_periods;
  const auto periods = [&](double decays) {
    return decay > 0.0 ? std::min(decays / decay, most_periods) : most_periods;
  };
  const double period = std::max(size.points, 1.0) * point_period;
  const double n_periods = is_single_frequency(scene)
                               ? std::min(periods(decays_from_rest), most_beside_a_resonance)
                               : periods(decays_from_rest) + (scene.response->n_time_points - 1) *
                                                                 periods(decays_of_a_step);
  return n_curves(scene) * period * (1.0 + size.points / points_of_a_step) * n_periods;
}

/// What a scene leaves out though it could have it, as a run puts it back: members of CurveEffects
/// that change then; nullptr: the evaluation takes as long.
std::vector<bool CurveEffects::*> members_left_out(const SceneDescription& scene) {
  struct Described {
    const char* name;
    bool CurveEffects::*member;
  };
  static constexpr std::array described{
      Described{"roughness", &CurveEffects::roughness},
      Described{"rate_dependence", &CurveEffects::rate_dependence},
      Described{"moments", &CurveEffects::areas},
      Described{"residual", &CurveEffects::residual},
      Described{"static_preload", nullptr},
      Described{"centrifugal", nullptr},
  };
  std::vector<bool CurveEffects::*> members;
  for (const Described& effect : described) {
    if (left_out(scene, effect.name) != nullptr) members.push_back(effect.member);
  }
  if (setting_of(scene, "second_direction") == "off" && can_move_along_r(scene)) {
    members.push_back(&CurveEffects::second_direction);
  }
  for (const char* name : {"normal_motion", "mean_coupling"}) {
    if (setting_of(scene, name) == "off") members.push_back(nullptr);
  }
  return members;
}

/// One evaluation with each of the effects that are left out, and one with all of them, where there
/// are several; more of those that are solved for more often.
double evaluations_with(const SceneDescription& scene, const CurveEffects& effects) {
  const std::vector<bool CurveEffects::*> members = members_left_out(scene);
  const auto seconds_with = [&](const CurveEffects& richer) {
    const bool in_plane = richer.second_direction && !effects.second_direction;
    const double often =
        in_plane && !scene.contacts.empty() ? of_the_second_direction_on_a_mesh : 1.0;
    return often * evaluation_seconds(richer, size_of(scene, richer));
  };
  CurveEffects all = effects;
  double seconds = 0.0;
  for (bool CurveEffects::*member : members) {
    CurveEffects one = effects;
    if (member != nullptr) one.*member = all.*member = true;
    seconds += seconds_with(one);
  }
  return members.size() > 1 ? seconds + seconds_with(all) : seconds;
}

/// Of a motion in time, as many integrations.
double integrations_with(const SceneDescription& scene, const CurveEffects& effects, double once) {
  const bool along_r = !effects.second_direction && can_move_along_r(scene) &&
                       setting_of(scene, "second_direction") == "auto";
  const auto n = static_cast<double>(members_left_out(scene).size()) + (along_r ? 1.0 : 0.0);
  return (n > 1.0 ? n + 1.0 : n) * once;
}

/// Of all curves. Where it is not known yet single frequencies are searched, no curves are.
double searched_share(const SceneDescription& scene, const CurveEffects& effects) {
  if (asked_starts(scene) > 0) return 1.0;
  if (setting_of(scene, "coexistence") == "off" || scene.response->search_starts) return 0.0;
  return effects.searched_share.value_or(is_single_frequency(scene) ? 1.0 : 0.0);
}

/// Of harmonics that are given, at the best value and beside it.
double seconds_of_richer_curves(const SceneDescription& scene, const CurveEffects& effects) {
  const Size size = size_of(scene, effects);
  if (check_seconds(scene, effects, size) == 0.0) return 0.0;
  return richer_curves_of_a_search *
         (of_a_curve * evaluation_seconds(effects, size) + check_seconds(scene, effects, size));
}

/// The search for a best value, and the same with uncertain numbers multiplied.
void add_search(const SceneDescription& scene, const CurveEffects& effects,
                ResponseSeconds& seconds) {
  // About: peaks alone are judged, and the curves of its error.
  constexpr double stable_curves = 10.0;
  const Size size = size_of(scene, effects);
  const double stability = std::max(stability_seconds(scene, effects, size), 0.0);
  const double search = of_a_search * evaluation_seconds(effects, size);
  const double judged = stable_curves * points_of_a_curve * stability;
  if (!has_short_search(scene)) {
    seconds.best_value =
        (1.0 + searches_of_its_error) * search + judged + seconds_of_richer_curves(scene, effects);
    seconds.bracket = searches_of_a_bracket * (search + judged);
    return;
  }
  seconds.best_value = of_a_short_search * evaluation_seconds(effects, size) + judged;
  Size few = size;
  few.harmonics = few_harmonics;
  seconds.bracket = searches_of_a_bracket * of_a_search * evaluation_seconds(effects, few);
}

}  // namespace

bool can_move_along_r(const SceneDescription& scene) {
  const auto* modal = std::get_if<ModalModel>(&scene.model);
  return modal == nullptr ? !scene.contacts.empty()
                          : modal->shapes.w.size() > 0 && !modal->shapes.w.isZero(0.0);
}

CurveEffects curve_effects(const SceneDescription& scene, bool second_direction) {
  const HarmonicSettings& harmonics = scene.settings.harmonics;
  return {.second_direction = second_direction,
          .normal_motion = is_rough(scene) || setting_of(scene, "normal_motion") != "off",
          .mean = setting_of(scene, "mean_coupling") != "off",
          .several_harmonics = harmonics.highest > 1,
          .chosen_harmonics = harmonics.chosen(),
          .roughness = is_rough(scene),
          .rate_dependence = is_rate_dependent(scene),
          .areas = scene.areas,
          .residual = scene.settings.basis.residual != ResidualKind::none,
          .stability = scene.judges_stability};
}

int usual_harmonics(const SceneDescription& scene) {
  const HarmonicSettings& given = scene.settings.harmonics;
  return given.chosen() ? n_chosen(scene) : given.highest;
}

ResponseSeconds response_seconds(const SceneDescription& scene, const CurveEffects& effects) {
  const Size size = size_of(scene, effects);
  const double evaluation = evaluation_seconds(effects, size);
  const double stability = stability_seconds(scene, effects, size);
  const bool one = is_single_frequency(scene);
  ResponseSeconds seconds;
  if (scene.response->method == ResponseDescription::Method::time) {
    seconds.curves = seconds_in_time(scene, size);
    if (scene.accuracy.error_budget)
      seconds.errors = integrations_with(scene, effects, seconds.curves);
  } else {
    const double more = has_many_events(scene, effects, size) ? of_many_events
                        : opens_at_once(scene, effects)       ? of_one_point_that_opens
                                                              : 1.0;
    const double evaluations = more * (one                        ? of_one_frequency
                                       : effects.chosen_harmonics ? of_a_choosing_curve
                                                                  : of_a_curve);
    const double n_linear = effects.linear_curves;
    seconds.curves =
        (n_curves(scene) - n_linear) *
        (std::max(0.5 * evaluations * evaluation,
                  evaluations * evaluation + (one ? 1.0 : points_of_a_curve) * stability) +
         check_seconds(scene, effects, size));
    seconds.curves +=
        searched_share(scene, effects) *
        search_seconds(scene, effects, likely_starts(scene, effects.second_direction));
    if (scene.accuracy.error_budget) {
      const bool meshed = !scene.contacts.empty();
      const double in_plane = effects.second_direction ? 2.0 : 1.0;
      const double of_rows =
          in_plane * (!effects.chosen_harmonics        ? of_error_rows
                      : scene.accuracy.tolerance > 0.0 ? of_error_rows_to_a_tolerance
                                                       : of_error_rows_of_chosen);
      // What one harmonic leaves out is looked at along the whole curve.
      const double rows = meshed                      ? of_rows * evaluation
                          : effects.several_harmonics ? 0.0
                                                      : points_of_a_curve * evaluation;
      const double check = meshed ? of_an_effect_on_a_mesh : of_an_effect;
      const double n_with_rows = n_curves(scene) - (1.0 - rows_of_a_linear_curve) * n_linear;
      seconds.errors = n_with_rows * (rows + check * evaluations_with(scene, effects));
    }
  }
  if (scene.response->optimum) add_search(scene, effects, seconds);
  for (double* stage : {&seconds.curves, &seconds.errors, &seconds.best_value, &seconds.bracket}) {
    *stage *= machine_slowness();
  }
  return seconds;
}

double begun_seconds(const SceneDescription& scene, const CurveEffects& effects, long n_evaluations,
                     long n_points) {
  const Size size = size_of(scene, effects);
  return static_cast<double>(n_evaluations) * evaluation_seconds(effects, size) +
         static_cast<double>(n_points) * stability_seconds(scene, effects, size);
}

double search_beside_folds(double n_folds) { return 1.0 + 2.0 * n_folds / frequencies_of_a_search; }

double search_of_a_curve(const SceneDescription& scene, const CurveEffects& effects, int n_starts) {
  const bool one = is_single_frequency(scene);
  const double starts =
      n_starts * (one ? of_a_start : frequencies_of_a_search * of_a_start_beside_a_curve);
  const double followed = one && n_starts > 0 ? of_a_curve : 0.0;  // its own branch
  const Size size = size_of(scene, effects);
  return (starts + followed) * evaluation_seconds(effects, size);
}

double search_seconds(const SceneDescription& scene, const CurveEffects& effects, int n_starts) {
  return n_curves(scene) * search_of_a_curve(scene, effects, n_starts);
}

}  // namespace microslip::pipelines
