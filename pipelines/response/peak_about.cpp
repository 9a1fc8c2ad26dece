#include "pipelines/response/peak_about.hpp"

#include <algorithm>

#include "pipelines/response/highest_peak.hpp"
#include "pipelines/response/solver_scenes.hpp"
#include "solver/continuation.hpp"

namespace microslip::pipelines {

solver::ResponseCurve curve_for_its_peak(const solver::Scene& scene,
                                         solver::ContinuationOptions options) {
  options.search_starts = 0;
  options.judge_stability = false;
  const auto goes_on = [&options](const auto&) { return !(options.stop && options.stop()); };
  return solver::trace_response(scene, options, goes_on);
}

std::optional<solver::ResponsePoint> peak_about(const ReducedModel& model, double load,
                                                solver::ContinuationOptions options,
                                                double frequency) {
  constexpr double beside = 0.015;  // of the frequency
  for (double* end : {&options.frequency_begin, &options.frequency_end}) {
    *end = std::clamp(*end, (1.0 - beside) * frequency, (1.0 + beside) * frequency);
  }
  const solver::ResponseCurve curve = curve_for_its_peak(solver_scene(model, load), options);
  const solver::ResponsePoint* peak = peak_above_all(curve);
  if (!curve.complete || peak == nullptr) return std::nullopt;
  return *peak;
}

}  // namespace microslip::pipelines
