/// The cubic between two instants: exact on parabolas, C¹ from one step to the next,
/// derivatives against differences.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "contact/sampled/step_spline.hpp"

namespace microslip::contact::sampled::test_step_spline {
namespace {

std::array<double, 4> drawn(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  std::array<double, 4> w{};
  for (double& number : w) number = normal(random);
  return w;
}

TEST(StepSpline, IsExactOnParabolas) {
  const auto parabola = [](double x) { return 2.0 - 3.0 * x + 0.7 * x * x; };
  const StepSpline spline({parabola(-1.0), parabola(0.0), parabola(1.0), parabola(2.0)});
  for (const double x : {0.0, 0.3, 0.5, 0.9, 1.0}) {
    EXPECT_NEAR(spline.at(x), parabola(x), 1e-15);
    EXPECT_NEAR(spline.slope_at(x), -3.0 + 1.4 * x, 1e-14);
    EXPECT_NEAR(spline.bend_at(x), 1.4, 1e-14);
  }
}

TEST(StepSpline, GoesOnWithTheSameSlopeInTheNextStep) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 20; ++i) {
    const auto w = drawn(random);
    const auto more = drawn(random);
    const StepSpline first(w);
    const StepSpline next({w[1], w[2], w[3], more[0]});
    EXPECT_NEAR(first.at(1.0), next.at(0.0), 1e-14);
    EXPECT_NEAR(first.slope_at(1.0), next.slope_at(0.0), 1e-14);
  }
}

TEST(StepSpline, SharesAreItsDerivatives) {
  std::mt19937_64 random(2);
  const auto w = drawn(random);
  for (const double x : {0.0, 0.2, 0.6, 1.0}) {
    const auto shares = StepSpline::shares(x);
    const auto slopes = StepSpline::slope_shares(x);
    double value = 0.0;
    double slope = 0.0;
    for (std::size_t j = 0; j < 4; ++j) {
      value += shares[j] * w[j];
      slope += slopes[j] * w[j];
    }
    EXPECT_NEAR(value, StepSpline(w).at(x), 1e-14);  // linear in w
    EXPECT_NEAR(slope, StepSpline(w).slope_at(x), 1e-14);
  }
}

TEST(StepSpline, TurnsWhereItsSlopeVanishes) {
  std::mt19937_64 random(3);
  int n_turns = 0;
  int n_twice = 0;
  for (int i = 0; i < 20000; ++i) {
    const StepSpline spline(drawn(random));
    const double scale = std::abs(spline.slope) + std::abs(spline.square) + std::abs(spline.cube);
    const bool turns = spline.slope_at(0.0) * spline.slope_at(1.0) < 0.0;
    for (const double side : {1.0, -1.0}) {
      if (turns && side * spline.slope < 0.0) continue;
      const double x = spline.turn(side);
      if (!turns && (x == 0.0 || x == 1.0 ||
                     spline.square * spline.square < 3.0 * spline.slope * spline.cube)) {
        continue;
      }
      ++(turns ? n_turns : n_twice);
      EXPECT_NEAR(spline.slope_at(x), 0.0, 1e-12 * scale);
      EXPECT_LE(side * spline.bend_at(x), 0.0);
    }
  }
  EXPECT_GT(n_turns, 5000);
  EXPECT_GT(n_twice, 50);
}

// A load as it is in time: smooth over the step. Two steps of Newton's method from the chord.
TEST(StepSpline, RisesThroughZeroWhereTheSignalDoes) {
  constexpr double step = 0.05;
  for (double offset = -0.9; offset < 0.95; offset += 0.1) {
    const auto load = [&](double x) {
      return std::sin(step * (x + offset)) + 0.2 * step * offset * offset;
    };
    const StepSpline spline({load(-1.0), load(0.0), load(1.0), load(2.0)});
    if (!(load(0.0) < 0.0 && load(1.0) > 0.0)) continue;
    const double x = spline.rise_through_zero(load(1.0) - load(0.0));
    EXPECT_NEAR(spline.at(x), 0.0, 1e-12);
    EXPECT_NEAR(load(x), 0.0, 1e-4 * step);  // of third order
  }
}

}  // namespace
}  // namespace microslip::contact::sampled::test_step_spline
