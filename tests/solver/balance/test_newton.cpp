#include "solver/balance/newton.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "solver/branch/branch_walker.hpp"

namespace microslip::solver::test_newton {
namespace {

BalanceEvaluation scalar(double residual, double slope, double by_parameter) {
  BalanceEvaluation e;
  e.residual = Eigen::VectorXd::Constant(1, residual);
  e.jacobian = Eigen::MatrixXd::Constant(1, 1, slope);
  e.parameter_derivative = Eigen::VectorXd::Constant(1, by_parameter);
  e.contact_force = Eigen::VectorXd::Zero(1);
  return e;
}

BranchVector at(double x, double p) { return {Eigen::VectorXd::Constant(1, x), p}; }

TEST(Newton, ConvergesBetweenTwoRegimesOfAKinkedForce) {
  // x + 10 max(0, x) = 1 from the soft side: the full step lands beyond the kink.
  const ParametricSystem system = [](const Eigen::VectorXd& x, double) {
    return scalar(x[0] + 10.0 * std::max(0.0, x[0]) - 1.0, x[0] > 0.0 ? 11.0 : 1.0, 0.0);
  };
  const auto result = solve_newton(system, at(-1.0, 0.0), Scaling{}, {});
  ASSERT_TRUE(result.converged);
  EXPECT_NEAR(result.point.x[0], 1.0 / 11.0, 1e-15);
}

TEST(Newton, SaysWhenItDoesNotConverge) {
  const ParametricSystem system = [](const Eigen::VectorXd& x, double) {
    return scalar(x[0] * x[0] + 1.0, 2.0 * x[0], 0.0);
  };
  EXPECT_FALSE(solve_newton(system, at(0.7, 0.0), Scaling{}, {}).converged);
}

TEST(Newton, EndsAtTheEvaluationsGiven) {
  const ParametricSystem system = [](const Eigen::VectorXd& x, double) {
    return scalar(x[0] * x[0] + 1.0, 2.0 * x[0], 0.0);
  };
  const NewtonResult all = solve_newton(system, at(0.7, 0.0), Scaling{}, {.max_iterations = 40});
  const NewtonResult few =
      solve_newton(system, at(0.7, 0.0), Scaling{}, {.max_iterations = 40, .max_evaluations = 3});
  constexpr int of_a_line_search = 8;
  EXPECT_GT(all.evaluations, 3 + of_a_line_search);
  EXPECT_LE(few.evaluations, 3 + of_a_line_search);
  EXPECT_FALSE(few.converged);
}

TEST(Newton, NonFiniteForcesEndTheIteration) {
  const ParametricSystem system = [](const Eigen::VectorXd&, double) {
    return scalar(std::nan(""), 1.0, 0.0);
  };
  EXPECT_FALSE(solve_newton(system, at(0.7, 0.0), Scaling{}, {}).converged);
}

// x = 1 is the root to the last bit, but the force is known to 1e-6 only.
TEST(Newton, AResidualThatIsNotKnownIsNotSmall) {
  const auto system = [](double defect) {
    return [defect](const Eigen::VectorXd& x, double) {
      BalanceEvaluation e = scalar(x[0] - 1.0, 1.0, 0.0);
      e.defect = defect;
      return e;
    };
  };
  EXPECT_TRUE(solve_newton(system(0.0), at(0.0, 0.0), Scaling{}, {}).converged);
  const NewtonResult vague = solve_newton(system(1e-6), at(0.0, 0.0), Scaling{}, {});
  EXPECT_FALSE(vague.converged);
  EXPECT_NEAR(vague.residual, 1e-6, 1e-12);
}

/// The circle x² + p² = 1: four quarter turns with two folds.
TEST(BranchWalker, GoesRoundACircle) {
  const ParametricSystem circle = [](const Eigen::VectorXd& x, double p) {
    return scalar(x[0] * x[0] + p * p - 1.0, 2.0 * x[0], 2.0 * p);
  };
  auto start = solve_newton(circle, at(1.0, 0.0), Scaling{}, {});
  BranchWalker walker(
      circle, [](const NewtonResult&) { return Scaling{}; }, start, 1.0);
  double turned = 0.0;
  double before = 0.0;
  for (int i = 0; i < 500 && turned < 2.0 * M_PI; ++i) {
    ASSERT_TRUE(walker.advance());
    const auto& point = walker.now().solution.point;
    ASSERT_NEAR(std::hypot(point.x[0], point.parameter), 1.0, 1e-11);
    const double angle = std::atan2(point.parameter, point.x[0]);
    const double step = std::remainder(angle - before, 2.0 * M_PI);
    ASSERT_GT(step, 0.0) << "no turning back";
    turned += step;
    before = angle;
  }
  EXPECT_GE(turned, 2.0 * M_PI);
}

/// A branch that turns back sharply at x = 1: p = x below, p = 1 − 3 (x − 1) above. In the
/// parameter it is a fold without a vertical tangent, as where slip begins.
TEST(BranchWalker, TurnsBackAtASharpKink) {
  const ParametricSystem kink = [](const Eigen::VectorXd& x, double p) {
    return x[0] <= 1.0 ? scalar(p - x[0], -1.0, 1.0)
                       : scalar(p - 1.0 + 3.0 * (x[0] - 1.0), 3.0, 1.0);
  };
  auto start = solve_newton(kink, at(0.0, 0.0), Scaling{}, {});
  BranchWalker walker(
      kink, [](const NewtonResult&) { return Scaling{}; }, start, 1.0);
  for (int i = 0; i < 200 && walker.now().solution.point.x[0] < 1.3; ++i) {
    ASSERT_TRUE(walker.advance());
  }
  EXPECT_GE(walker.now().solution.point.x[0], 1.3);
  EXPECT_LT(walker.now().solution.point.parameter, 0.2);
}

TEST(NullVector, KeepsTheOrientation) {
  const auto e = scalar(0.0, 2.0, 1.0);
  const auto forward = null_vector(e, Scaling{}, 1.0);
  const auto backward = null_vector(e, Scaling{}, -1.0);
  ASSERT_TRUE(forward && backward);
  EXPECT_NEAR(2.0 * forward->x[0] + forward->parameter, 0.0, 1e-15);
  EXPECT_NEAR(forward->x[0] + backward->x[0], 0.0, 1e-15);
  EXPECT_GT(2.0 * forward->parameter - forward->x[0], 0.0);  // det [2 1; x p]
}

TEST(Newton, PolishesToRounding) {
  const ParametricSystem system = [](const Eigen::VectorXd& x, double p) {
    return scalar(x[0] * x[0] * x[0] - p, 3.0 * x[0] * x[0], -1.0);
  };
  const auto result = solve_newton(system, at(2.0, 3.0), Scaling{}, {});
  ASSERT_TRUE(result.converged);
  EXPECT_NEAR(result.point.x[0], std::cbrt(3.0), 1e-15);
  EXPECT_EQ(result.point.parameter, 3.0);
}

// From 1.5 the residual of x² = 2 is 6e-3, 6e-6 and 5e-12, then rounding.
TEST(Newton, DoesNotPolishRounding) {
  const ParametricSystem system = [](const Eigen::VectorXd& x, double) {
    return scalar(x[0] * x[0] - 2.0 + 3e-16, 2.0 * x[0], 0.0);
  };
  const auto result = solve_newton(system, at(1.5, 0.0), Scaling{}, {.tolerance = 1e-13});
  ASSERT_TRUE(result.converged);
  EXPECT_NEAR(result.point.x[0], std::sqrt(2.0), 1e-15);
  EXPECT_GT(result.residual, 0.0);
  EXPECT_EQ(result.evaluations, result.iterations + 1);
}

TEST(Newton, AsksNoResidualBelowItsRounding) {
  // A residual that never falls below 1e-8, with the tolerance at 1e-11.
  const ParametricSystem system = [](const Eigen::VectorXd& x, double) {
    return scalar(x[0] + (x[0] > 0.0 ? 1e-8 : -1e-8), 1.0, 0.0);
  };
  EXPECT_FALSE(solve_newton(system, at(1.0, 0.0), Scaling{}, {}).converged);
  Scaling noisy;
  noisy.rounding = 2e-8;
  const auto result = solve_newton(system, at(1.0, 0.0), noisy, {});
  EXPECT_TRUE(result.converged);
  EXPECT_LE(result.residual, 2e-8);
}

TEST(Newton, StaysOnThePlaneOfItsConstraint) {
  const ParametricSystem circle = [](const Eigen::VectorXd& x, double p) {
    return scalar(x[0] * x[0] + p * p - 1.0, 2.0 * x[0], 2.0 * p);
  };
  Scaling scaling;
  scaling.x = 0.5;
  scaling.parameter = 2.0;
  const auto result = solve_newton(circle, at(0.7, 0.9), at(0.6, 0.8), scaling, {});
  ASSERT_TRUE(result.converged);
  const double x = result.point.x[0];
  const double p = result.point.parameter;
  EXPECT_NEAR(std::hypot(x, p), 1.0, 1e-15);
  EXPECT_NEAR(0.6 * (x - 0.7) / 0.5 + 0.8 * (p - 0.9) / 2.0, 0.0, 1e-14);
}

}  // namespace
}  // namespace microslip::solver::test_newton
