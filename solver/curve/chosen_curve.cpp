#include "solver/curve/chosen_curve.hpp"

#include <chrono>

#include "solver/curve/branch_search.hpp"
#include "solver/enrichment/curve_harmonics.hpp"

namespace microslip::solver {

ResponseCurve trace_choosing(const Scene& scene, const ContinuationOptions& options,
                             const PointObserver& observe) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point begin = Clock::now();
  const auto first = [&](const HarmonicSet& set) {
    ContinuationOptions given = with_harmonics(options, set);
    given.search_starts = 0;
    return trace_response(scene, given, until_stopped(options));
  };
  bool is_first = true;
  const auto trace = [&](const HarmonicSet& set) {
    is_first = false;
    return trace_response(scene, with_harmonics(options, set), observe);
  };
  ResponseCurve curve = trace_with_chosen(scene, options, first, trace);
  if (is_first && options.search_starts > 0) search_branches(scene, options, curve);
  for (const ResponsePoint& point : curve.points) {
    if (is_first && observe && !observe(point)) break;
  }
  curve.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  return curve;
}

}  // namespace microslip::solver
