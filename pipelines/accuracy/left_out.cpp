#include "pipelines/accuracy/left_out.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <exception>
#include <limits>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "contact/contact_force.hpp"
#include "contact/dense.hpp"
#include "pipelines/description/effects_left_out.hpp"
#include "pipelines/effects/effect_choice.hpp"
#include "pipelines/model/contact_coordinates.hpp"
#include "pipelines/response/response_stage.hpp"
#include "pipelines/system/deadline.hpp"
#include "pipelines/system/scene_error.hpp"
#include "solver/richer_peak.hpp"

namespace microslip::pipelines {
namespace {

bool all_patches(const ReducedModel& model, int axis, double least) {
  return std::ranges::all_of(model.patches, [&](const contact::Patch& patch) {
    return patch.cells.stiffness.col(axis).minCoeff() >= least;
  });
}

/// Effects that a switch of the contact has.
void add_switched(const ReducedModel& model, const SceneDescription& scene, RicherModels& others) {
  const auto add = [&](const char* name, bool ContactEffects::*effect) {
    RicherModel& other = others.models.emplace_back(RicherModel{name, model});
    other.model.effects.*effect = true;
    other.model.coordinates = contact_coordinates(other.model, scene);
  };
  const auto moves = [](const contact::Patch& patch) {
    return !patch.cells.stiffness.col(1).isZero(0.0) && !patch.cells.shapes.v.isZero(0.0);
  };
  if (!model.effects.normal_motion && std::ranges::any_of(model.patches, moves)) {
    add("normal_motion", &ContactEffects::normal_motion);
  }
  const bool forbidden = setting_of(scene, "second_direction") == "off" &&
                         model.effects.motion_ratio > least_motion_along_r(scene);
  if (forbidden && !model.effects.second_direction && all_patches(model, 2, 0.0)) {
    add("second_direction", &ContactEffects::second_direction);
  }
}

/// Coordinates of one basis from those of another on the same mesh, by least squares.
Eigen::MatrixXd between(const fem::ModalBasis& from, const fem::ModalBasis& to) {
  return contact::solved(to.shapes.transpose() * to.shapes, to.shapes.transpose() * from.shapes);
}

/// The first modes are the same, those that follow stand still.
Eigen::MatrixXd with_more(const ReducedModel& from, const ReducedModel& to) {
  return Eigen::MatrixXd::Identity(to.frequency.size(), from.frequency.size());
}

/// With an effect that is taken out of the description of a scene.
RicherModel with_described(const char* name, const ReducedModel& model,
                           const SceneDescription& scene, const SolvedStructure* structure,
                           bool changes_modes) {
  const SceneDescription with = with_effect(scene, name);
  std::vector<std::string> warnings;  // those of the scene itself are told already
  RicherModel other{name, {}};
  if (structure != nullptr && changes_modes) {
    const SolvedStructure solved{structure->mesh, solve_structure(structure->mesh, with)};
    other.model = model_of(with, &solved, warnings);
    other.embedding = between(structure->modes.basis, solved.modes.basis);
  } else {
    other.model = model_of(with, structure, warnings);
    if (changes_modes) other.embedding = with_more(model, other.model);
  }
  other.model.effects = model.effects;
  if (is_rough(other.model)) other.model.effects.normal_motion = true;
  other.model.coordinates = contact_coordinates(other.model, with);
  return other;
}

struct Described {
  const char* name;
  bool changes_modes;
};

constexpr std::array described{Described{"roughness", false}, Described{"rate_dependence", false},
                               Described{"moments", false},   Described{"static_preload", false},
                               Described{"residual", true},   Described{"centrifugal", true}};

void add_described(const ReducedModel& model, const SceneDescription& scene,
                   const SolvedStructure* structure, RicherModels& others) {
  for (const Described& effect : described) {
    if (left_out(scene, effect.name) == nullptr || cut_short()) continue;
    const bool contradicts =
        std::string_view(effect.name) == "roughness" && setting_of(scene, "normal_motion") == "off";
    if (contradicts) continue;
    try {
      others.models.push_back(
          with_described(effect.name, model, scene, structure, effect.changes_modes));
    } catch (const InterruptedError&) {
      throw;
    } catch (const std::exception& error) {  // a check that fails does not cost the run
      others.unknown.emplace_back(effect.name);
      others.note =
          fmt::format("what leaving out {} changes is not known: {}", effect.name, error.what());
    }
  }
}

/// The peaks of a curve, each as a curve of its own, the highest first; without one the curve,
/// whose end is the highest.
std::vector<solver::ResponseCurve> single_peaks(const solver::ResponseCurve& curve) {
  std::vector<solver::ResponseCurve> peaks;
  for (const solver::ResponsePoint& point : curve.points) {
    if (point.mark == solver::PointMark::peak) peaks.emplace_back().points = {point};
  }
  std::ranges::stable_sort(peaks, std::ranges::greater{}, [](const solver::ResponseCurve& one) {
    return one.points.front().amplitude;
  });
  if (peaks.empty()) peaks.push_back(curve);
  return peaks;
}

/// By having an effect, the largest of all peaks: of amplitude over the highest one; of frequency,
/// of a lower peak by its share of that amplitude.
struct Changes {
  double amplitude = 0.0, frequency = 0.0;
  bool found = true;  ///< the highest peak with the effect
};

constexpr Changes not_found{std::numeric_limits<double>::infinity(),
                            std::numeric_limits<double>::infinity(), false};

double larger(double a, double b) { return std::abs(b) > std::abs(a) ? b : a; }

Changes changes_with(const solver::Scene& own, const solver::OtherModel& with,
                     const solver::ContinuationOptions& options, const solver::ResponseCurve& curve,
                     double highest) {
  Changes changes;
  bool is_highest = true;
  for (const solver::ResponseCurve& peak : single_peaks(curve)) {
    // Beside the highest the whole curve is looked at: it may be another place that is highest with
    // the effect.
    const auto both = solver::peak_elsewhere(own, options, is_highest ? curve : peak, with);
    if (both) {
      changes.amplitude =
          larger(changes.amplitude, (both->other_amplitude - both->amplitude) / highest);
      const double shift = both->other_frequency / both->frequency - 1.0;
      changes.frequency = larger(changes.frequency, shift * both->amplitude / highest);
    } else if (is_highest) {
      return not_found;
    } else {  // a lower one that is lost changes by all it has
      changes.amplitude = larger(changes.amplitude, -peak.points.front().amplitude / highest);
    }
    is_highest = false;
  }
  return changes;
}

/// As exact as the forces of both allow.
solver::ContinuationOptions options_of_both(const SceneDescription& scene,
                                            const ReducedModel& model, const ReducedModel& richer) {
  const bool sampled = contact::is_sampled(richer.patches, richer.effects);
  solver::ContinuationOptions options = continuation_options(scene, sampled ? richer : model);
  options.search_starts = 0;
  return options;
}

/// The static preload with an effect may be another one.
double load_with(const ReducedModel& richer, const ReducedModel& model, double load) {
  return load == model.static_preload ? richer.static_preload.value_or(load) : load;
}

/// @param model  as the curve was solved.
Changes changes_with(const SceneDescription& scene, const ReducedModel& model,
                     const RicherModel& other, const CurveResult& result, double load) {
  const solver::ResponsePoint& peak = *highest_peak(result.curve);
  ReducedModel richer = other.model;
  richer.effects.located = richer.effects.located || model.effects.located;
  const double factor = frequency_factor(model, richer, peak.frequency);
  const solver::Scene own = solver_scene(model, load);
  try {
    const solver::Scene with = solver_scene(richer, load_with(richer, model, load));
    return changes_with(own, {with, other.embedding, factor}, options_of_both(scene, model, richer),
                        result.curve, peak.amplitude);
  } catch (const RefusedError&) {  // such a load cannot be with it: there is no peak
    return not_found;
  }
}

}  // namespace

RicherModels models_left_out(const ReducedModel& model, const SceneDescription& scene,
                             const SolvedStructure* structure) {
  RicherModels others;
  if (model.patches.empty()) return others;
  add_switched(model, scene, others);
  add_described(model, scene, structure, others);
  return others;
}

std::vector<ErrorRow> rows_left_out(const ReducedModel& simulated, const SceneDescription& scene,
                                    const std::vector<RicherModel>& others,
                                    const CurveResult& result) {
  const ReducedModel model = model_of(simulated, result.curve);
  const auto* load = std::get_if<double>(&result.load);
  const solver::ResponsePoint* peak = highest_peak(result.curve);
  if (load == nullptr || peak == nullptr || result.integrated || !(peak->amplitude > 0.0))
    return {};
  std::vector<ErrorRow> rows;
  for (const RicherModel& other : others) {
    if (cut_short()) break;
    const auto begin = std::chrono::steady_clock::now();
    const Changes changes = changes_with(scene, model, other, result, *load);
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    const ErrorKind kind = changes.found ? ErrorKind::solved : ErrorKind::estimated;
    rows.push_back(
        {result.name, peak_amplitude_goal, other.source, changes.amplitude, kind, seconds});
    rows.push_back(
        {result.name, peak_frequency_goal, other.source, changes.frequency, kind, seconds});
  }
  return rows;
}

}  // namespace microslip::pipelines
