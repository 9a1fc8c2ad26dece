#include "pipelines/response/peak_about.hpp"

#include <algorithm>

#include "pipelines/response/highest_peak.hpp"
#include "pipelines/response/solver_scenes.hpp"
#include "solver/continuation.hpp"

namespace microslip::pipelines {

std::optional<solver::ResponsePoint> peak_about(const ReducedModel& model, double load,
                                                solver::ContinuationOptions options,
                                                double frequency) {
  constexpr double beside = 0.015;  // of the frequency
  for (double* end : {&options.frequency_begin, &options.frequency_end}) {
    *end = std::clamp(*end, (1.0 - beside) * frequency, (1.0 + beside) * frequency);
  }
  options.search_starts = 0;
  options.judge_stability = false;
  const auto goes_on = [&options](const auto&) { return !(options.stop && options.stop()); };
  const solver::ResponseCurve curve =
      solver::trace_response(solver_scene(model, load), options, goes_on);
  const solver::ResponsePoint* peak = peak_above_all(curve);
  if (!curve.complete || peak == nullptr) return std::nullopt;
  return *peak;
}

}  // namespace microslip::pipelines
