#include "pipelines/time_response.hpp"

#include <algorithm>
#include <chrono>
#include <numbers>
#include <vector>

#include <fmt/format.h>

#include "solver/time_integration.hpp"

namespace microslip::pipelines {
namespace {

std::vector<double> swept_frequencies(const ResponseDescription& response) {
  const double begin = 2.0 * std::numbers::pi * response.frequency_begin_hz;
  const double end = 2.0 * std::numbers::pi * response.frequency_end_hz;
  if (begin == end) return {begin};
  std::vector<double> frequencies;
  for (int i = 0; i < response.n_time_points; ++i) {
    frequencies.push_back(begin + (end - begin) * i / (response.n_time_points - 1));
  }
  return frequencies;
}

void mark_peak(solver::ResponseCurve& curve) {
  const auto best = std::max_element(
      curve.points.begin(), curve.points.end(),
      [](const auto& a, const auto& b) { return a.amplitude < b.amplitude; });
  // Read off the list of frequencies, not solved for: an end of it is no peak.
  if (curve.points.size() > 2 && best != curve.points.begin() && best + 1 != curve.points.end()) {
    best->mark = solver::PointMark::peak;
  }
}

solver::ResponseCurve sweep(const solver::Scene& scene, const ResponseDescription& response,
                            const solver::PointObserver& observe) {
  solver::TimeOptions options;
  options.n_harmonics = std::max(response.harmonics, least_harmonics_of_time);
  solver::ResponseCurve curve;
  int n_left_out = 0;
  solver::TimeState state;
  bool started = false;
  for (const double frequency : swept_frequencies(response)) {
    const solver::TimeSystem system(scene, frequency);
    if (!started) state = solver::state_at_rest(system);
    started = true;
    try {
      const solver::TimePoint point = solver::integrate_to_steady_state(system, options, state);
      curve.iterations += point.n_periods;
      if (!point.periodic) {
        ++n_left_out;
        continue;
      }
      curve.points.push_back(point.response);
    } catch (const solver::TimeError& error) {
      curve.diagnosis = error.diagnosis();
      curve.message = fmt::format("at {:g} Hz: {}", frequency / (2.0 * std::numbers::pi), error.what());
      return curve;
    }
    if (observe && !observe(curve.points.back())) {
      curve.diagnosis = "interrupted";
      return curve;
    }
  }
  curve.complete = n_left_out == 0;
  if (n_left_out > 0) {
    curve.diagnosis = "not-periodic";
    curve.message = fmt::format("{} of {} frequencies have no periodic motion within {} periods",
                                n_left_out, n_left_out + static_cast<int>(curve.points.size()),
                                options.max_periods);
  }
  mark_peak(curve);
  return curve;
}

}  // namespace

solver::ResponseCurve integrate_curve(const solver::Scene& scene,
                                      const ResponseDescription& response,
                                      const solver::PointObserver& observe) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point begin = Clock::now();
  solver::ResponseCurve curve = sweep(scene, response, observe);
  curve.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  return curve;
}

}  // namespace microslip::pipelines
