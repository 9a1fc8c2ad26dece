#include "solver/point_shift.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "solver/continuation.hpp"
#include "tests/support/floating_point_traps.hpp"
#include "tests/support/modal_scenes.hpp"

namespace microslip::solver::test_point_shift {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

ContinuationOptions range(ContinuationOptions::Corrector corrector) {
  ContinuationOptions options;
  options.frequency_begin = two_pi * 18.0;
  options.frequency_end = two_pi * 28.0;
  options.n_harmonics = 3;
  options.corrector = corrector;
  return options;
}

std::vector<ResponsePoint> marks_of(const ResponseCurve& curve) {
  std::vector<ResponsePoint> marks;
  std::ranges::copy_if(curve.points, std::back_inserter(marks), [](const ResponsePoint& point) {
    return point.mark == PointMark::peak || point.mark == PointMark::fold;
  });
  return marks;
}

/// Peaks and folds of forces sampled coarsely, moved to where located events have them. A peak of
/// the curve lies within its resolution of the highest place, where it is 1e-6 lower.
TEST(PointShift, TellsWhereLocatedEventsHavePeaksAndFolds) {
  const tests::UntrappedFloatingPoint lanes_divide_before_they_choose;
  int n_folds = 0;
  for (const double preload : {10.0, 30.0, 50.0, 100.0}) {
    Scene located = tests::three_dof_scene(preload);
    tests::use_event_cycles(located);
    Scene sampled = tests::three_dof_scene(preload);
    tests::use_lanes(sampled, 64);
    const auto exact =
        marks_of(trace_response(located, range(ContinuationOptions::Corrector::newton)));
    const auto coarse =
        marks_of(trace_response(sampled, range(ContinuationOptions::Corrector::few_jacobians)));
    ASSERT_EQ(exact.size(), coarse.size()) << preload;
    ASSERT_FALSE(exact.empty()) << preload;
    for (std::size_t i = 0; i < exact.size(); ++i) {
      ASSERT_EQ(exact[i].mark, coarse[i].mark);
      const auto shift = point_shift(located, coarse[i]);
      ASSERT_TRUE(shift.has_value()) << preload;
      const bool fold = exact[i].mark == PointMark::fold;
      n_folds += fold ? 1 : 0;
      const double frequency = exact[i].frequency / coarse[i].frequency - 1.0;
      const double amplitude = exact[i].amplitude / coarse[i].amplitude - 1.0;
      std::printf("%g N, %s at %.3f Hz: frequency %+.2e told %+.2e, amplitude %+.2e told %+.2e\n",
                  preload, fold ? "fold" : "peak", exact[i].frequency / two_pi, frequency,
                  shift->frequency, amplitude, shift->amplitude);
      if (fold) {
        EXPECT_NEAR(shift->frequency, frequency, 0.15 * std::abs(frequency) + 1e-8);
      } else {
        EXPECT_NEAR(shift->amplitude, amplitude, 0.15 * std::abs(amplitude) + 1e-6);
      }
    }
  }
  EXPECT_GT(n_folds, 2);
}

/// The same at the frequency of points beside the peaks, where located events are solved for.
TEST(AmplitudeShift, TellsAmplitudesOfLocatedEventsAtOneFrequency) {
  const tests::UntrappedFloatingPoint lanes_divide_before_they_choose;
  int n_told = 0;
  Scene located = tests::three_dof_scene(50.0);
  tests::use_event_cycles(located);
  Scene sampled = tests::three_dof_scene(50.0);
  tests::use_lanes(sampled, 64);
  const ContinuationOptions own = range(ContinuationOptions::Corrector::newton);
  const ResponseCurve coarse =
      trace_response(sampled, range(ContinuationOptions::Corrector::few_jacobians));
  for (std::size_t i = 0; i < coarse.points.size(); i += 4) {
    const ResponsePoint& point = coarse.points[i];
    if (point.mark != PointMark::none) continue;
    ContinuationOptions near = own;
    near.near_begin = point.q;
    const ResponseCurve exact = solve_at_frequency(located, point.frequency, near);
    ASSERT_TRUE(exact.complete);
    const double amplitude = exact.points.front().amplitude / point.amplitude - 1.0;
    if (std::abs(amplitude) > 0.05) continue;  // another branch
    const auto shift = amplitude_shift(located, own, point);
    ASSERT_TRUE(shift.has_value());
    EXPECT_NEAR(*shift, amplitude, 0.15 * std::abs(amplitude) + 1e-6) << point.frequency / two_pi;
    ++n_told;
  }
  EXPECT_GT(n_told, 5);
}

}  // namespace
}  // namespace microslip::solver::test_point_shift
