#include "solver/peak/high_points.hpp"

#include <algorithm>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/support/modal_scenes.hpp"

namespace microslip::solver::test_high_points {
namespace {

ContinuationOptions chain_range(double end_hz = 28.0) {
  ContinuationOptions options;
  options.frequency_begin = 2.0 * std::numbers::pi * 18.0;
  options.frequency_end = 2.0 * std::numbers::pi * end_hz;
  return options;
}

const ResponsePoint& peak_of(const ResponseCurve& curve) {
  return *std::find_if(curve.points.begin(), curve.points.end(),
                       [](const auto& point) { return point.mark == PointMark::peak; });
}

TEST(HighPoints, AreThePeaksAndTheEndsOfTheRange) {
  const Scene scene = tests::chain_scene(30.0);
  const ResponseCurve curve = trace_response(scene, chain_range());
  const auto high = high_points(scene, curve, chain_range());
  ASSERT_EQ(high.size(), 3U);
  EXPECT_EQ(high[0].place, PeakPlace::peak);
  EXPECT_FALSE(high[0].climbed);
  EXPECT_EQ(high[0].point.amplitude, peak_of(curve).amplitude);
  for (const std::size_t i : {1U, 2U}) EXPECT_EQ(high[i].place, PeakPlace::range_end);
  EXPECT_GE(high[1].point.amplitude, high[2].point.amplitude);
}

TEST(HighPoints, ClimbToAPeakThatTheCurveHasLost) {
  const Scene scene = tests::chain_scene(30.0);
  ResponseCurve curve = trace_response(scene, chain_range());
  const ResponsePoint peak = peak_of(curve);
  std::erase_if(curve.points, [](const auto& point) { return point.mark == PointMark::peak; });
  const auto high = high_points(scene, curve, chain_range());
  ASSERT_EQ(high.size(), 3U);
  EXPECT_TRUE(high[0].climbed);
  EXPECT_EQ(high[0].place, PeakPlace::peak);
  // Two solutions of one peak: amplitudes agree to rounding, frequencies to its root.
  EXPECT_NEAR(high[0].point.amplitude, peak.amplitude, 1e-10 * peak.amplitude);
  EXPECT_NEAR(high[0].point.frequency, peak.frequency, 1e-6 * peak.frequency);
}

TEST(HighPoints, DoNotTakeTheLastPointOfAnIncompleteCurveForAnEnd) {
  const Scene scene = tests::chain_scene(30.0);
  ResponseCurve curve = trace_response(scene, chain_range());
  const auto peak = std::find_if(curve.points.begin(), curve.points.end(),
                                 [](const auto& point) { return point.mark == PointMark::peak; });
  curve.points.erase(peak, curve.points.end());
  curve.complete = false;
  const auto high = high_points(scene, curve, chain_range());
  ASSERT_EQ(high.size(), 2U);
  EXPECT_EQ(high[0].place, PeakPlace::unsolved);
  EXPECT_EQ(high[0].point.frequency, curve.points.back().frequency);
  EXPECT_EQ(high[1].place, PeakPlace::range_end);
}

}  // namespace
}  // namespace microslip::solver::test_high_points
