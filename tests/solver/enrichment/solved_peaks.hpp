/// @file
/// Peaks that the tests start from and compare with: the highest of a whole curve.
#pragma once

#include <gtest/gtest.h>

#include "solver/continuation.hpp"
#include "solver/peak/high_points.hpp"

namespace microslip::tests {

struct SolvedPeak {
  solver::HarmonicSet set{1};
  solver::LocalPeak peak;
};

inline SolvedPeak solved_peak(const solver::Scene& scene, solver::ContinuationOptions range,
                              const solver::HarmonicSet& set) {
  range.harmonic_tolerance = 0.0;
  range.n_harmonics = set.highest();
  range.orders = set.orders();
  const auto curve = solver::trace_response(scene, range);
  const auto high = solver::high_points(scene, curve, range);
  SolvedPeak solved{set, {}};
  solver::HarmonicBalance balance(scene, set);
  if (high.empty()) {
    ADD_FAILURE() << curve.diagnosis;
    return solved;
  }
  const auto& point = high.front().point;
  const auto peak = high.front().place == solver::PeakPlace::peak
                        ? solver::local_peak(balance, point)
                        : solver::local_end(balance, point, range);
  EXPECT_TRUE(peak.has_value());
  if (peak) solved.peak = *peak;
  return solved;
}

}  // namespace microslip::tests
