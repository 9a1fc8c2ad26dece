#include "pipelines/response/curve_trial.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <numbers>
#include <optional>
#include <vector>

#include "pipelines/description/curve_request.hpp"
#include "pipelines/effects/effect_choice.hpp"
#include "pipelines/model/curve_load.hpp"
#include "pipelines/response/response_stage.hpp"
#include "pipelines/system/deadline.hpp"
#include "pipelines/system/interrupt.hpp"
#include "pipelines/system/machine_speed.hpp"
#include "pipelines/system/scene_error.hpp"

namespace microslip::pipelines {
namespace {

/// Else too short to tell what an evaluation takes.
constexpr double least_trial = 0.1;  // [s]
/// Of the contact, for a first solution: where they take longer nothing is begun.
constexpr long first_evaluations = 30;

double processor_seconds() {
  return static_cast<double>(std::clock()) / static_cast<double>(CLOCKS_PER_SEC);
}

SceneDescription without_search(SceneDescription scene) {
  scene.response->search_starts = 0;
  return scene;
}

/// Which share of a curve lies between its beginning and a frequency: that of the points of both
/// linear limits, which are close where they resonate.
class WayAlong {
 public:
  WayAlong(const ReducedModel& model, const SceneDescription& scene)
      : is_upward_(scene.response->frequency_end_hz > scene.response->frequency_begin_hz) {
    for (const LimitName limit : {LimitName::free, LimitName::stuck}) {
      for (const solver::ResponsePoint& point : limit_curve(model, scene, limit).points) {
        frequencies_.push_back(point.frequency);
      }
    }
  }

  [[nodiscard]] double share_before(double frequency) const {
    const auto n = std::ranges::count_if(
        frequencies_, [&](double one) { return is_upward_ ? one <= frequency : one >= frequency; });
    return static_cast<double>(n) /
           static_cast<double>(std::max<std::size_t>(frequencies_.size(), 1));
  }

 private:
  std::vector<double> frequencies_;  // [rad/s]
  bool is_upward_;
};

/// What was done of a curve.
struct Trial {
  double seconds = 0.0;
  double before_first_point = 0.0;  ///< of them: few harmonics, from which more are chosen
  double walked = 0.0;              ///< of them: to the last point, without checks of the curve
  double share = 0.0;               ///< of its way
  long evaluations = 0;
  long points = 0;
  long folds = 0;
  bool complete = false;
  bool is_linear = false;  // proved
};

Trial try_curve(const ReducedModel& model, const SceneDescription& scene,
                const CurveRequest& request, const WayAlong& way, double seconds) {
  const TimeLimit limit(scene.response->time_budget);
  const double begin = processor_seconds();
  const auto spent = [begin] { return processor_seconds() - begin; };
  Trial trial;
  const auto observe = [&](const solver::ResponsePoint& point) {
    if (trial.points++ == 0) trial.before_first_point = spent();
    trial.share = std::max(trial.share, way.share_before(point.frequency));
    if (point.mark == solver::PointMark::fold) ++trial.folds;
    trial.walked = spent();
    return trial.walked < seconds && !interrupt_requested();
  };
  const CurveResult result = trace_curve(model, scene, request, observe);
  trial.seconds = spent();
  if (trial.points == 0) trial.walked = trial.seconds;  // few harmonics, and a choice of more
  trial.evaluations = result.curve.contact_evaluations;
  trial.is_linear = !result.curve.certificate.empty();
  using enum solver::Diagnosis;
  trial.complete = result.curve.diagnosis != interrupted && result.curve.diagnosis != budget &&
                   !result.lacks_time && !limit.is_over();
  return trial;
}

/// Of a whole curve. The pace of a beginning says little. @param before  what it was forecast to
/// take. @param slowness  as measured.
double seconds_of(const Trial& trial, double before, double slowness) {
  if (trial.complete) return trial.seconds;
  const double on_the_way = trial.seconds - trial.before_first_point;
  constexpr double beside_a_choice = 3.0;  // of harmonics, about
  if (!(trial.share > 0.0) || !(on_the_way > 0.0)) {
    // Evaluations with few harmonics, so far, take less than they were said to.
    return std::max(std::max(slowness, 1.0) * before, beside_a_choice * trial.seconds);
  }
  const double by_pace = on_the_way / trial.share;
  const double of_way = std::max(before - trial.before_first_point, on_the_way);
  const double weight = std::cbrt(trial.share);
  const double rest = std::pow(by_pace, weight) * std::pow(of_way, 1.0 - weight);
  return trial.seconds + (1.0 - trial.share) * rest;
}

/// Curves under a load.
std::vector<CurveRequest> loaded_curves(const SceneDescription& scene) {
  std::vector<CurveRequest> requests = curve_requests(scene);
  std::erase_if(requests, [](const CurveRequest& one) { return !is_loaded(one); });
  return requests;
}

/// Those of one scene, each for an equal part of the time that is left. One that is refused, as it
/// will be where it is solved for, was not begun.
std::vector<Trial> try_curves(const ReducedModel& model, SceneDescription scene, double seconds) {
  const std::vector<CurveRequest> requests = loaded_curves(scene);
  const WayAlong way(model, scene);
  std::vector<Trial> trials;
  for (std::size_t n_left = requests.size(); n_left > 0 && !interrupt_requested(); --n_left) {
    const double part = seconds / static_cast<double>(n_left);
    constexpr double by_the_clock = 3.0;  // beside other programs
    scene.response->time_budget = by_the_clock * part;
    Trial& trial = trials.emplace_back();
    try {
      trial = try_curve(model, scene, requests[requests.size() - n_left], way, part);
    } catch (const RefusedError&) {
    }
    seconds -= trial.seconds;
  }
  return trials;
}

/// What an evaluation of the contact took over what it was said to take.
double slowness_of(const std::vector<Trial>& trials, const SceneDescription& scene,
                   const CurveEffects& effects) {
  double tried = 0.0;
  double expected = 0.0;
  for (const Trial& trial : trials) {
    tried += trial.walked;
    expected += begun_seconds(scene, effects, trial.evaluations, trial.points);
  }
  if (!(tried > least_trial) || !(expected > 0.0)) return 1.0;
  // What more it took may be stability, which neither a search nor a best value judges.
  constexpr double most = 4.0;
  return std::min(tried / (expected * machine_slowness()), most);
}

/// Folds of a curve, of those that were begun.
double mean_folds(const std::vector<Trial>& trials) {
  double folds = 0.0;
  for (const Trial& trial : trials) folds += static_cast<double>(trial.folds);
  return folds / std::max(static_cast<double>(trials.size()), 1.0);
}

}  // namespace

ResponseSeconds tried_seconds(const ReducedModel& model, const SceneDescription& scene,
                              const CurveEffects& effects, double seconds) {
  ResponseSeconds told = response_seconds(scene, effects);
  if (in_time(scene) || is_linear_study(scene)) return told;
  if (begun_seconds(scene, effects, first_evaluations, 0) > seconds) return told;
  const SceneDescription alone = without_search(scene);
  CurveEffects unsearched = effects;
  unsearched.searched_share = 0.0;
  const double without = response_seconds(alone, unsearched).curves;
  const std::vector<Trial> trials = try_curves(model, alone, seconds);
  const auto n = static_cast<double>(trials.size());
  const double slowness = slowness_of(trials, scene, effects);
  const double search =
      slowness * search_beside_folds(mean_folds(trials)) * (told.curves - without);
  told.curves = search;
  for (const Trial& trial : trials) {
    told.curves += seconds_of(trial, without / std::max(1.0, n - effects.linear_curves), slowness);
  }
  CurveEffects proved = effects;
  proved.linear_curves = static_cast<int>(std::ranges::count_if(trials, &Trial::is_linear));
  if (proved.linear_curves > effects.linear_curves) {
    told.errors = response_seconds(scene, proved).errors;
  }
  for (double* stage : {&told.best_value, &told.bracket}) *stage *= slowness;
  // Errors of a mesh are those of other models, which evaluate other contacts.
  if (scene.contacts.empty()) told.errors *= slowness;
  return told;
}

}  // namespace microslip::pipelines
