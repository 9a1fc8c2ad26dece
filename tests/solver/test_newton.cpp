#include "solver/newton.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace microslip::solver {
namespace {

/// A scalar equation f(x, p) = 0 with ∂f/∂x and ∂f/∂p.
template <typename Function>
ParametricSystem scalar(Function function) {
  return [function](const Eigen::VectorXd& x, double p) {
    const Eigen::Vector3d values = function(x[0], p);
    BalanceEvaluation at;
    at.residual = values.segment<1>(0);
    at.jacobian = values.segment<1>(1);
    at.parameter_derivative = values.segment<1>(2);
    return at;
  };
}

BranchVector point(double x, double p) { return {Eigen::VectorXd::Constant(1, x), p}; }

TEST(Newton, SolvesToRounding) {
  const auto system =
      scalar([](double x, double p) { return Eigen::Vector3d(x * x * x - p, 3.0 * x * x, -1.0); });
  const NewtonResult result = solve_newton(system, point(2.0, 3.0), Scaling{}, {});
  ASSERT_TRUE(result.converged);
  EXPECT_NEAR(result.point.x[0], std::cbrt(3.0), 1e-15);  // polished below the tolerance
  EXPECT_EQ(result.point.parameter, 3.0);
}

TEST(Newton, SettlesBetweenTwoRegimesThatThrowTheFullStepToAndFro) {
  // sign(x) √|x|: the full step goes from x to −x for ever.
  const auto system = scalar([](double x, double) {
    const double root = std::sqrt(std::abs(x));
    return Eigen::Vector3d(std::copysign(root, x), 0.5 / std::max(root, 1e-300), 0.0);
  });
  NewtonOptions options;
  options.tolerance = 1e-6;
  options.max_iterations = 60;
  const NewtonResult result = solve_newton(system, point(1.0, 0.0), Scaling{}, options);
  EXPECT_TRUE(result.converged);
  EXPECT_LT(std::abs(result.point.x[0]), 1e-12);
}

TEST(Newton, SaysSoWhenThereIsNoSolution) {
  const auto system =
      scalar([](double x, double) { return Eigen::Vector3d(x * x + 1.0, 2.0 * x, 0.0); });
  EXPECT_FALSE(solve_newton(system, point(0.7, 0.0), Scaling{}, {}).converged);
}

TEST(Newton, SaysSoWhenTheResidualIsNotFinite) {
  const auto system = scalar([](double, double) {
    return Eigen::Vector3d(std::numeric_limits<double>::quiet_NaN(), 1.0, 0.0);
  });
  EXPECT_FALSE(solve_newton(system, point(0.7, 0.0), Scaling{}, {}).converged);
}

TEST(Newton, AsksNoResidualBelowItsRounding) {
  // A residual with a floor of 1e-8: never below the tolerance of 1e-11.
  const auto system = scalar([](double x, double) {
    return Eigen::Vector3d(x + 1e-8 * (x > 0.0 ? 1.0 : -1.0), 1.0, 0.0);
  });
  EXPECT_FALSE(solve_newton(system, point(1.0, 0.0), Scaling{}, {}).converged);
  Scaling noisy;
  noisy.rounding = 2e-8;
  const NewtonResult result = solve_newton(system, point(1.0, 0.0), noisy, {});
  EXPECT_TRUE(result.converged);
  EXPECT_LE(result.residual, 2e-8);
}

TEST(Newton, StaysOnThePlaneOfItsConstraint) {
  const auto circle = scalar(
      [](double x, double p) { return Eigen::Vector3d(x * x + p * p - 1.0, 2.0 * x, 2.0 * p); });
  Scaling scaling;
  scaling.x = 0.5;
  scaling.parameter = 2.0;
  const BranchVector row = point(0.6, 0.8);
  const BranchVector start = point(0.7, 0.9);
  const NewtonResult result = solve_newton(circle, start, row, scaling, {});
  ASSERT_TRUE(result.converged);
  const double x = result.point.x[0];
  const double p = result.point.parameter;
  EXPECT_NEAR(std::hypot(x, p), 1.0, 1e-15);
  EXPECT_NEAR(0.6 * (x - 0.7) / 0.5 + 0.8 * (p - 0.9) / 2.0, 0.0, 1e-14);
}

TEST(BranchTangent, FollowsTheBranchThroughItsFolds) {
  const auto circle = scalar(
      [](double x, double p) { return Eigen::Vector3d(x * x + p * p - 1.0, 2.0 * x, 2.0 * p); });
  BranchVector direction = point(0.0, 1.0);
  double orientation = 0.0;
  for (int i = 0; i <= 100; ++i) {
    const double angle = 2.0 * 3.14159265358979 * i / 100.0;
    const auto at = circle(Eigen::VectorXd::Constant(1, std::cos(angle)), std::sin(angle));
    const Tangent tangent = branch_tangent(at, direction, Scaling{});
    EXPECT_NEAR(tangent.direction.x[0], -std::sin(angle), 1e-14);
    EXPECT_NEAR(tangent.direction.parameter, std::cos(angle), 1e-14);
    if (i > 0) {
      EXPECT_EQ(tangent.orientation, orientation);
    }
    orientation = tangent.orientation;
    direction = tangent.direction;
    const auto null = null_vector(at, Scaling{}, orientation);
    ASSERT_TRUE(null.has_value());
    EXPECT_NEAR(null->x[0], direction.x[0], 1e-14);
    EXPECT_NEAR(null->parameter, direction.parameter, 1e-14);
  }
}

}  // namespace
}  // namespace microslip::solver
