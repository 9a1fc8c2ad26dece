#include "solver/time/time_segment.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace microslip::solver::test_time_segment {
namespace {

Eigen::VectorXd scalar(double x) { return Eigen::VectorXd::Constant(1, x); }

/// q = sin t from t to t + h.
TimeSegment sine(double t, double h) {
  return {t,
          h,
          {scalar(std::sin(t)), scalar(std::cos(t))},
          scalar(2.0 * std::cos(t + 0.5 * h) * std::sin(0.5 * h)),
          scalar(-2.0 * std::sin(t + 0.5 * h) * std::sin(0.5 * h)),
          scalar(-std::sin(t)),
          scalar(-std::sin(t + h))};
}

TEST(TimeSegment, MeetsBothEnds) {
  const TimeSegment segment = sine(0.4, 0.3);
  EXPECT_NEAR(segment.at(0.0).q[0], std::sin(0.4), 1e-16);
  EXPECT_NEAR(segment.at(0.0).velocity[0], std::cos(0.4), 1e-16);
  EXPECT_NEAR(segment.at(1.0).q[0], std::sin(0.7), 1e-15);
  EXPECT_NEAR(segment.at(1.0).velocity[0], std::cos(0.7), 1e-15);
}

TEST(TimeSegment, IsOfOrderSixInDisplacementAndFiveInVelocity) {
  const auto error = [](double h) {
    double q = 0.0;
    double velocity = 0.0;
    for (double x = 0.05; x < 1.0; x += 0.05) {
      q = std::max(q, std::abs(sine(0.4, h).at(x).q[0] - std::sin(0.4 + x * h)));
      velocity =
          std::max(velocity, std::abs(sine(0.4, h).at(x).velocity[0] - std::cos(0.4 + x * h)));
    }
    return std::pair(q, velocity);
  };
  const auto coarse = error(0.8);
  const auto fine = error(0.4);
  EXPECT_GT(std::log2(coarse.first / fine.first), 5.8);
  EXPECT_GT(std::log2(coarse.second / fine.second), 4.8);
}

TEST(TimeSegment, KeepsItsVelocityInVeryShortSteps) {
  for (const double h : {1e-4, 1e-8, 1e-12}) {
    for (const double x : {0.0, 0.3, 0.7, 1.0}) {
      EXPECT_NEAR(sine(0.4, h).at(x).velocity[0], std::cos(0.4 + x * h), 1e-15) << h;
    }
  }
}

}  // namespace
}  // namespace microslip::solver::test_time_segment
