#include "solver/continuation.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "duffing.hpp"
#include "tests/support/random_scene.hpp"

namespace microslip::solver {
namespace {

using tests::Duffing;

ContinuationOptions from_to(double begin, double end) {
  ContinuationOptions options;
  options.frequency_begin = begin;
  options.frequency_end = end;
  return options;
}

std::vector<ResponsePoint> marked(const ResponseCurve& curve, PointMark mark) {
  std::vector<ResponsePoint> list;
  std::copy_if(curve.points.begin(), curve.points.end(), std::back_inserter(list),
               [&](const ResponsePoint& point) { return point.mark == mark; });
  return list;
}

TEST(Continuation, EveryPointLiesOnTheClosedFormOfDuffing) {
  const Duffing duffing;
  const auto curve = trace_response(duffing.scene(), from_to(0.5, 2.5));
  ASSERT_TRUE(curve.complete) << curve.message;
  EXPECT_EQ(curve.points.front().frequency, 0.5);
  EXPECT_EQ(curve.points.back().frequency, 2.5);
  for (const ResponsePoint& point : curve.points) {
    EXPECT_LT(std::abs(duffing.defect(point.amplitude, point.frequency)), 1e-9);
  }
}

TEST(Continuation, SolvesForFoldsWhereTheTangentIsVertical) {
  const Duffing duffing;
  const auto curve = trace_response(duffing.scene(), from_to(0.5, 2.5));
  const auto folds = marked(curve, PointMark::fold);
  ASSERT_EQ(folds.size(), 2U);
  for (const ResponsePoint& fold : folds) {
    // Relative to the slope a linear response of this amplitude would have.
    EXPECT_LT(std::abs(duffing.slope(fold.amplitude, fold.frequency)), 1e-6 * 2.0 * fold.amplitude);
  }
  EXPECT_GT(folds[0].frequency, folds[1].frequency);
}

TEST(Continuation, ThePeakIsWhereTheForceMeetsTheDampingAlone) {
  const Duffing duffing;
  const auto peaks = marked(trace_response(duffing.scene(), from_to(0.5, 2.5)), PointMark::peak);
  ASSERT_EQ(peaks.size(), 1U);
  const double A = peaks[0].amplitude;
  const double omega = peaks[0].frequency;
  // ∂F²/∂ω = 0: (1 − ω² + ¾αA²) = 2ζ²
  EXPECT_NEAR(1.0 - omega * omega + 0.75 * duffing.alpha * A * A,
              2.0 * duffing.zeta * duffing.zeta, 1e-8);
}

TEST(Continuation, BetweenFoldsAndNowhereElseThePointsAreUnstable) {
  const auto curve = trace_response(Duffing{}.scene(), from_to(0.5, 2.5));
  int folds = 0;
  for (const ResponsePoint& point : curve.points) {
    if (point.mark == PointMark::fold) {
      ++folds;
      continue;
    }
    EXPECT_EQ(point.stability, folds == 1 ? Stability::unstable : Stability::stable)
        << point.frequency;
    EXPECT_EQ(point.determinant_sign, folds == 1 ? -1.0 : 1.0);
  }
}

TEST(Continuation, FindsPeaksAMillionTimesNarrowerThanTheRange) {
  Duffing duffing;
  duffing.alpha = 0.0;
  duffing.zeta = 1e-6;
  const auto curve = trace_response(duffing.scene(), from_to(0.5, 1.5));
  const auto peaks = marked(curve, PointMark::peak);
  ASSERT_EQ(peaks.size(), 1U);
  EXPECT_NEAR(peaks[0].amplitude, duffing.force / (2.0 * duffing.zeta),
              1e-6 * peaks[0].amplitude);
}

TEST(Continuation, ReversedAndForwardSweepsMeetTheSameMarks) {
  const auto up = trace_response(Duffing{}.scene(), from_to(0.5, 2.5));
  const auto down = trace_response(Duffing{}.scene(), from_to(2.5, 0.5));
  const auto a = marked(up, PointMark::fold);
  auto b = marked(down, PointMark::fold);
  std::reverse(b.begin(), b.end());
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i].frequency, b[i].frequency, 1e-9);
}

TEST(Continuation, WithoutForceNothingMoves) {
  tests::SinglePoint single;
  single.force = 0.0;
  single.point = {2.0, 1.0, 0.3, 1.0};
  single.phi_v = 0.5;
  const auto curve = trace_response(tests::single_point_scene(single), from_to(0.5, 2.0));
  ASSERT_TRUE(curve.complete);
  for (const ResponsePoint& point : curve.points) {
    EXPECT_EQ(point.amplitude, 0.0);
    EXPECT_EQ(point.residual, 0.0);
    EXPECT_EQ(point.energy_imbalance, 0.0);
  }
}

TEST(Continuation, ALargeForceTendsToTheFreeResponse) {
  tests::SinglePoint single;
  single.point = {2.0, 0.0, 0.3, 1.0};
  single.force = 1e9;
  const tests::SinglePoint free = single;
  const auto rubbed = solve_at_frequency(tests::single_point_scene(single), 0.7, {});
  const double linear = free.force / std::hypot(1.0 - 0.49, 2.0 * 0.01 * 0.7);
  ASSERT_TRUE(rubbed.complete);
  EXPECT_NEAR(rubbed.points.front().amplitude, linear, 1e-8 * linear);
}

TEST(Continuation, APeakAtTheEndOfTheRangeIsSaid) {
  Duffing duffing;
  duffing.alpha = 0.0;
  const auto curve = trace_response(duffing.scene(), from_to(0.5, 0.95));
  EXPECT_TRUE(curve.complete);
  EXPECT_NE(curve.message.find("peak at boundary"), std::string::npos);
  EXPECT_TRUE(marked(curve, PointMark::peak).empty());
}

TEST(Continuation, StopsWhenTheObserverSaysSo) {
  int n = 0;
  const auto curve = trace_response(Duffing{}.scene(), from_to(0.5, 2.5),
                                    [&](const ResponsePoint&) { return ++n < 5; });
  EXPECT_FALSE(curve.complete);
  EXPECT_EQ(curve.diagnosis, "interrupted");
  EXPECT_EQ(curve.points.size(), 5U);
}

TEST(Continuation, AFrequencyInsideAFoldHasThreeSolutions) {
  const auto scene = Duffing{}.scene();
  const auto options = from_to(0.5, 2.5);
  const auto curve = trace_response(scene, options);
  const auto folds = marked(curve, PointMark::fold);
  ASSERT_EQ(folds.size(), 2U);
  const double inside = 0.5 * (folds[0].frequency + folds[1].frequency);
  const auto points = points_at_frequency(scene, curve, inside, options);
  ASSERT_EQ(points.size(), 3U);
  for (const ResponsePoint& point : points) EXPECT_EQ(point.frequency, inside);
  EXPECT_EQ(points[1].stability, Stability::unstable);
  EXPECT_TRUE(points_at_frequency(scene, curve, 3.0, options).empty());
}

TEST(Continuation, RefusesFrequenciesThatAreNone) {
  EXPECT_THROW(static_cast<void>(trace_response(Duffing{}.scene(), from_to(0.0, 1.0))),
               std::invalid_argument);
  EXPECT_THROW(static_cast<void>(trace_response(Duffing{}.scene(), from_to(1.0, std::nan("")))),
               std::invalid_argument);
}

}  // namespace
}  // namespace microslip::solver
