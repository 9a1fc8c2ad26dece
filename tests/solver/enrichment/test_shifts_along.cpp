#include "solver/point_shift.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "solver/continuation.hpp"
#include "tests/support/modal_scenes.hpp"

namespace microslip::solver::test_shifts_along {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

ContinuationOptions range(int n_harmonics) {
  ContinuationOptions options;
  options.frequency_begin = two_pi * 18.0;
  options.frequency_end = two_pi * 28.0;
  options.n_harmonics = n_harmonics;
  return options;
}

Scene located_scene(double preload) {
  Scene scene = tests::three_dof_scene(preload);
  tests::use_event_cycles(scene);
  return scene;
}

/// What more harmonics change an amplitude by at its frequency, over what shifts tell there.
struct Comparison {
  double amplitude = 0.0;  ///< over that of the point
  double told = 0.0;       ///< the same: by the amplitude's shift, and the slope by the frequency's
};

std::vector<Comparison> compared(const Scene& scene, const ResponseCurve& curve,
                                 const std::vector<PointShift>& told) {
  std::vector<Comparison> result;
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    const ResponsePoint& point = curve.points[i];
    if (!point.slope || point.mark != PointMark::none) continue;
    ContinuationOptions many = range(9);
    many.near_begin = point.q;
    const ResponseCurve rich = solve_at_frequency(scene, point.frequency, many);
    if (!rich.complete) continue;
    const double amplitude = rich.points.front().amplitude / point.amplitude - 1.0;
    if (std::abs(amplitude) > 0.1) continue;  // another branch
    const double steep = std::abs(point.slope->amplitude) * point.frequency / point.amplitude;
    result.push_back({std::abs(amplitude), told[i].amplitude + steep * told[i].frequency});
  }
  return result;
}

// One harmonic in place of nine, of a contact that opens: at most points, those between the ones
// that were looked at among them, the amplitude changes by no more than is told, and by a good part
// of it.
TEST(ShiftsAlong, TellWhatMoreHarmonicsDoBesideThePeaks) {
  for (const double preload : {10.0, 50.0}) {
    const Scene scene = located_scene(preload);
    const ResponseCurve curve = trace_response(scene, range(1));
    ASSERT_TRUE(curve.complete);
    const std::vector<PointShift> told = shifts_along(scene, curve, 9, {});
    ASSERT_EQ(told.size(), curve.points.size());
    std::vector<double> shares;
    for (const Comparison& one : compared(scene, curve, told)) {
      if (one.amplitude > 1e-4) shares.push_back(one.told / one.amplitude);
    }
    ASSERT_GT(shares.size(), 10U);
    std::ranges::sort(shares);
    const double quarter = shares[shares.size() / 4];
    const double median = shares[shares.size() / 2];
    std::printf(
        "%g N: of %zu points told over true %.2f in the lowest quarter, %.2f in the median\n",
        preload, shares.size(), quarter, median);
    EXPECT_GT(quarter, 0.5);
    EXPECT_GT(median, 0.8);
    EXPECT_LT(median, 2.5);
  }
}

TEST(ShiftsAlong, AreNothingWhereNoHarmonicIsLeftOut) {
  const Scene scene = located_scene(50.0);
  const ResponseCurve curve = trace_response(scene, range(3));
  for (const PointShift& one : shifts_along(scene, curve, 3, {})) {
    EXPECT_EQ(one.amplitude, 0.0);
    EXPECT_EQ(one.frequency, 0.0);
  }
}

TEST(ShiftsAlong, EndWhenAsked) {
  const Scene scene = located_scene(50.0);
  const ResponseCurve curve = trace_response(scene, range(1));
  EXPECT_TRUE(shifts_along(scene, curve, 9, [] { return true; }).empty());
}

}  // namespace
}  // namespace microslip::solver::test_shifts_along
