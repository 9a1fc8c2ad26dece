#include "pipelines/accuracy/amplitude_band.hpp"

#include <cmath>
#include <cstddef>
#include <vector>

#include <gtest/gtest.h>

namespace microslip::pipelines::test_amplitude_band {
namespace {

constexpr double far = 1e-12;  // rounding

/// A triangle with its peak at ω = 100, A = 1, 0.01 of amplitude less for each of frequency.
CurveResult triangle() {
  CurveResult result;
  result.name = "one";
  for (int i = -20; i <= 20; ++i) {
    solver::ResponsePoint& point = result.curve.points.emplace_back();
    point.frequency = 100.0 + i;
    point.amplitude = 1.0 - 0.01 * std::abs(i);
  }
  result.curve.points[20].mark = solver::PointMark::peak;
  return result;
}

CurveBudget budget(double frequency, double amplitude, double harmonics) {
  CurveBudget result;
  result.rows = {{"one", peak_amplitude_goal, "mesh", -amplitude},
                 {"one", peak_frequency_goal, "mesh", frequency},
                 {"one", peak_amplitude_goal, "harmonics", harmonics},
                 {"one", peak_frequency_goal, "harmonics", 0.0}};
  return result;
}

// Without an error of the frequency it is the bar of the amplitude, on both sides.
TEST(AmplitudeBand, IsTheBarWhereNothingElseIsKnown) {
  const CurveResult result = triangle();
  const AmplitudeBand band = amplitude_band(result, budget(0.0, 0.02, 0.03));
  for (std::size_t i = 0; i < result.curve.points.size(); ++i) {
    const double amplitude = result.curve.points[i].amplitude;
    EXPECT_NEAR(band.low[i], 0.95 * amplitude, far);
    EXPECT_NEAR(band.high[i], 1.05 * amplitude, far);
  }
}

// A curve that lies 2.5 % of its frequency off has the amplitude of a place so far away.
TEST(AmplitudeBand, IsAsWideAsTheFrequencyMakesItOnAFlank) {
  const CurveResult result = triangle();
  const AmplitudeBand band = amplitude_band(result, budget(0.025, 0.0, 0.0));
  EXPECT_NEAR(band.low[10], 0.9 - 0.0225, far);
  EXPECT_NEAR(band.high[10], 0.9 + 0.0225, far);
  EXPECT_NEAR(band.high[20], 1.0, far);
  EXPECT_NEAR(band.low[20], 0.975, far);
  EXPECT_NEAR(band.high[19], 1.0, far) << "the peak itself may lie there";
}

// Harmonics count as they do at each point, of the highest peak as its own row has them.
TEST(AmplitudeBand, HarmonicsCountWhereTheyDo) {
  const CurveResult result = triangle();
  CurveBudget errors = budget(0.0, 0.01, 0.002);
  errors.along.assign(result.curve.points.size(), {0.0, 0.0});
  errors.along[5].amplitude = 0.2;
  errors.along[20].amplitude = 0.5;
  const AmplitudeBand band = amplitude_band(result, errors);
  EXPECT_NEAR(band.high[5], 0.85 * 1.21, far);
  EXPECT_NEAR(band.low[5], 0.85 * 0.79, far);
  EXPECT_NEAR(band.high[6], 0.86 * 1.01, far);
  EXPECT_NEAR(band.high[20], 1.012, far);
}

// A range ends where somebody has set its end: the curve goes on.
TEST(AmplitudeBand, ReachesBeyondTheEndsOfTheRange) {
  CurveResult result = triangle();
  result.curve.points.front().slope = solver::BranchSlope{0.01, 0.0};
  result.curve.points.back().slope = solver::BranchSlope{-0.01, 0.0};
  const AmplitudeBand band = amplitude_band(result, budget(0.025, 0.0, 0.0));
  EXPECT_NEAR(band.low[40], 0.8 * std::exp(-0.01 * 0.025 * 120.0 / 0.8), far);
  EXPECT_NEAR(band.high[40], 0.8 + 0.01 * 0.025 * 120.0, far);
  EXPECT_NEAR(band.low[0], 0.8 * std::exp(-0.01 * 0.025 * 80.0 / 0.8), far);
  EXPECT_NEAR(band.low[39], 0.8 * std::exp(-0.01 * (0.025 * 119.0 - 1.0) / 0.8), far);
}

// Where a branch turns back, it has amplitudes of both of its sides.
TEST(AmplitudeBand, HoldsBothSidesOfAFold) {
  CurveResult result = triangle();
  std::vector<solver::ResponsePoint>& points = result.curve.points;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double along = static_cast<double>(i) - 30.0;
    points[i].frequency = 110.0 - 0.01 * along * along;  // turns at 30, A = 0.9
  }
  const AmplitudeBand band = amplitude_band(result, budget(0.001, 0.0, 0.0));
  EXPECT_LE(band.low[30], points[33].amplitude);
  EXPECT_GE(band.high[30], points[27].amplitude);
}

TEST(AmplitudeBand, IsNeverBelowZero) {
  const AmplitudeBand band = amplitude_band(triangle(), budget(0.0, 1.5, 0.0));
  for (const double low : band.low) EXPECT_EQ(low, 0.0);
}

}  // namespace
}  // namespace microslip::pipelines::test_amplitude_band
