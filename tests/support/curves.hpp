/// @file
/// What tests of response curves ask for and look at.
#pragma once

#include <algorithm>
#include <iterator>
#include <vector>

#include "solver/continuation.hpp"

namespace microslip::tests {

/// Default options from one angular frequency to the other [rad/s].
[[nodiscard]] inline solver::ContinuationOptions frequency_range(double begin, double end) {
  solver::ContinuationOptions options;
  options.frequency_begin = begin;
  options.frequency_end = end;
  return options;
}

/// The points of a curve with one mark, in its order.
[[nodiscard]] inline std::vector<solver::ResponsePoint> marked(const solver::ResponseCurve& curve,
                                                               solver::PointMark mark) {
  std::vector<solver::ResponsePoint> list;
  std::copy_if(curve.points.begin(), curve.points.end(), std::back_inserter(list),
               [&](const solver::ResponsePoint& point) { return point.mark == mark; });
  return list;
}

/// The largest amplitude of a whole curve, ends of the range included [m].
[[nodiscard]] inline double highest_of_curve(const solver::Scene& scene,
                                             const solver::ContinuationOptions& options) {
  double highest = 0.0;
  for (const auto& point : solver::trace_response(scene, options).points) {
    highest = std::max(highest, point.amplitude);
  }
  return highest;
}

}  // namespace microslip::tests
