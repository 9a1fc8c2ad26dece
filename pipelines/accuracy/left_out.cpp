#include "pipelines/accuracy/left_out.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "pipelines/effects/effect_choice.hpp"
#include "pipelines/model/contact_coordinates.hpp"
#include "pipelines/response/response_stage.hpp"
#include "pipelines/system/deadline.hpp"
#include "solver/richer_peak.hpp"

namespace microslip::pipelines {
namespace {

struct WithEffect {
  std::string name;
  ReducedModel model;
};

bool all_patches(const ReducedModel& model, int axis, double least) {
  return std::ranges::all_of(model.patches, [&](const contact::Patch& patch) {
    return patch.cells.stiffness.col(axis).minCoeff() >= least;
  });
}

std::vector<WithEffect> models_with(const ReducedModel& model, const SceneDescription& scene) {
  std::vector<WithEffect> others;
  const auto add = [&](const char* name, bool ContactEffects::*effect) {
    WithEffect& other = others.emplace_back(WithEffect{name, model});
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
  return others;
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

double larger(double a, double b) { return std::abs(b) > std::abs(a) ? b : a; }

Changes changes_with(const solver::Scene& own, const solver::Scene& with,
                     const solver::ContinuationOptions& options, const solver::ResponseCurve& curve,
                     double highest) {
  constexpr double not_found = std::numeric_limits<double>::infinity();
  Changes changes;
  bool is_highest = true;
  for (const solver::ResponseCurve& peak : single_peaks(curve)) {
    // Beside the highest the whole curve is looked at: it may be another place that is highest with
    // the effect.
    const auto both =
        solver::peak_elsewhere(own, options, is_highest ? curve : peak, {.scene = with});
    if (both) {
      changes.amplitude =
          larger(changes.amplitude, (both->other_amplitude - both->amplitude) / highest);
      const double shift = both->other_frequency / both->frequency - 1.0;
      changes.frequency = larger(changes.frequency, shift * both->amplitude / highest);
    } else if (is_highest) {
      return {not_found, not_found, false};
    } else {  // a lower one that is lost changes by all it has
      changes.amplitude = larger(changes.amplitude, -peak.points.front().amplitude / highest);
    }
    is_highest = false;
  }
  return changes;
}

}  // namespace

std::vector<ErrorRow> rows_left_out(const ReducedModel& simulated, const SceneDescription& scene,
                                    const CurveResult& result) {
  const ReducedModel model = model_of(simulated, result.curve);
  const auto* load = std::get_if<double>(&result.load);
  const solver::ResponsePoint* peak = highest_peak(result.curve);
  if (load == nullptr || peak == nullptr || result.integrated || !(peak->amplitude > 0.0))
    return {};
  solver::ContinuationOptions options = continuation_options(scene, model);
  options.search_starts = 0;
  const solver::Scene own = solver_scene(model, *load);
  std::vector<ErrorRow> rows;
  for (const WithEffect& other : models_with(model, scene)) {
    if (cut_short()) break;
    const auto begin = std::chrono::steady_clock::now();
    const solver::Scene with = solver_scene(other.model, *load);
    const Changes changes = changes_with(own, with, options, result.curve, peak->amplitude);
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    const ErrorKind kind = changes.found ? ErrorKind::solved : ErrorKind::estimated;
    rows.push_back(
        {result.name, peak_amplitude_goal, other.name, changes.amplitude, kind, seconds});
    rows.push_back(
        {result.name, peak_frequency_goal, other.name, changes.frequency, kind, seconds});
  }
  return rows;
}

}  // namespace microslip::pipelines
