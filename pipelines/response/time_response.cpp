#include "pipelines/response/time_response.hpp"

#include <algorithm>
#include <chrono>
#include <numbers>
#include <vector>

#include <fmt/format.h>

#include "pipelines/system/scene_error.hpp"
#include "solver/time_integration.hpp"

namespace microslip::pipelines {
namespace {

std::vector<double> swept_frequencies(const ResponseDescription& response) {
  const double begin = 2.0 * std::numbers::pi * response.frequency_begin_hz;
  const double end = 2.0 * std::numbers::pi * response.frequency_end_hz;
  if (begin == end) return {begin};
  std::vector<double> frequencies;
  frequencies.reserve(static_cast<std::size_t>(response.n_time_points));
  for (int i = 0; i < response.n_time_points; ++i) {
    frequencies.push_back(begin + (end - begin) * i / (response.n_time_points - 1));
  }
  return frequencies;
}

solver::TimeOptions time_options(const SceneDescription& scene, const std::function<bool()>& stop,
                                 Closeness closely) {
  const ResponseDescription& response = *scene.response;
  solver::TimeOptions options;
  options.stop = stop;
  options.n_harmonics = std::max(scene.settings.harmonics.highest, least_harmonics_of_time);
  if (response.steps_per_period > 0) {
    options.method = solver::TimeMethod::rk4;
    options.steps_per_period = response.steps_per_period;
  }
  if (closely == Closeness::bound) {
    options.periodicity_tolerance = 1e-5;
    options.step_tolerance = 1e-8;  // a period has 64 and more
  }
  return options;
}

/// What is no periodic motion, or has another period than the excitation.
struct Irregular {
  int n_aperiodic = 0;
  int n_subharmonic = 0;
  double first = 0.0;  ///< subharmonic [rad/s]

  void add(const solver::TimePoint& point) {
    if (!point.periodic) ++n_aperiodic;
    if (point.period_multiple <= 1) return;
    if (n_subharmonic++ == 0) first = point.response.frequency;
  }

  void tell(const solver::TimeOptions& options, solver::ResponseCurve& curve) const {
    const auto n = static_cast<int>(curve.points.size()) + n_aperiodic;
    curve.complete = n_aperiodic == 0;
    if (n_aperiodic > 0) {
      curve.diagnosis = solver::Diagnosis::not_periodic;
      curve.message = fmt::format("{} of {} frequencies have no periodic motion within {} periods",
                                  n_aperiodic, n, options.max_periods);
    }
    if (n_subharmonic == 0) return;
    if (!curve.message.empty()) curve.message += "; ";
    curve.message += fmt::format(
        "at {} of {} frequencies, the first {:.6g} Hz, the motion repeats after several periods of "
        "the "
        "excitation only: not the solution of harmonic balance there (stable = -1)",
        n_subharmonic, n, first / (2.0 * std::numbers::pi));
  }
};

/// Beside what is told of the motions until then.
void tell_stop(double frequency, solver::ResponseCurve& curve) {
  curve.complete = false;
  curve.diagnosis = solver::Diagnosis::interrupted;
  curve.message = fmt::format("stopped at {:.8g} Hz{}{}", frequency / (2.0 * std::numbers::pi),
                              curve.message.empty() ? "" : "; ", curve.message);
}

solver::ResponseCurve sweep(const solver::Scene& scene, const SceneDescription& description,
                            const solver::PointObserver& observe, const std::function<bool()>& stop,
                            const contact::Harmonics* begin, Closeness closely) {
  const solver::TimeOptions options = time_options(description, stop, closely);
  solver::ResponseCurve curve;
  Irregular irregular;
  solver::TimeState state;
  bool started = false;
  for (const double frequency : swept_frequencies(*description.response)) {
    const solver::TimeSystem system(scene, frequency);
    if (!started) state = begin ? solver::state_on(system, *begin) : solver::state_at_rest(system);
    started = true;
    try {
      const solver::TimePoint point = solver::integrate_to_steady_state(system, options, state);
      curve.iterations += point.n_periods;
      if (point.stopped) {
        irregular.tell(options, curve);
        tell_stop(frequency, curve);
        return curve;
      }
      irregular.add(point);
      if (!point.periodic) continue;
      curve.points.push_back(point.response);
    } catch (const solver::TimeError& error) {
      curve.diagnosis = error.diagnosis();
      curve.message =
          fmt::format("at {:g} Hz: {}", frequency / (2.0 * std::numbers::pi), error.what());
      return curve;
    }
    if (observe && !observe(curve.points.back())) {
      irregular.tell(options, curve);
      tell_stop(frequency, curve);
      return curve;
    }
  }
  irregular.tell(options, curve);
  return curve;
}

}  // namespace

void require_steps(const solver::Scene& scene, const ResponseDescription& response) {
  if (response.steps_per_period == 0) return;
  const double lowest_hz =
      std::min(response.frequency_begin_hz, response.frequency_end_hz);  // the longest period
  const solver::TimeSystem system(scene, 2.0 * std::numbers::pi * lowest_hz);
  if (response.steps_per_period >= system.least_steps()) return;
  throw SceneError(fmt::format(
      "{}: {} steps per period are too few: with its contacts stuck the structure moves at up to "
      "{:.6g} Hz, and at "
      "{:.6g} Hz excitation that takes at least {}; 0 locates every change of contact instead",
      response.steps_place, response.steps_per_period,
      system.largest_frequency() / (2.0 * std::numbers::pi), lowest_hz, system.least_steps()));
}

solver::ResponseCurve integrate_curve(const solver::Scene& scene,
                                      const SceneDescription& description,
                                      const solver::PointObserver& observe,
                                      const std::function<bool()>& stop,
                                      const contact::Harmonics* begin, Closeness closely) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  solver::ResponseCurve curve = sweep(scene, description, observe, stop, begin, closely);
  curve.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  return curve;
}

}  // namespace microslip::pipelines
