#include "solver/balance/broyden.hpp"

#include <cmath>
#include <memory>

#include <gtest/gtest.h>
#include <Eigen/LU>

#include "solver/balance/branch_factors.hpp"
#include "solver/branch/branch_geometry.hpp"

namespace microslip::solver::test_branch_factors {
namespace {

/// Well conditioned, without symmetry.
Eigen::MatrixXd matrix(Eigen::Index n, double share) {
  Eigen::MatrixXd A(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      A(i, j) = (i == j ? 2.0 : 0.0) + share * std::sin(1.0 + 3.0 * static_cast<double>(i * n + j));
    }
  }
  return A;
}

TEST(Broyden, ALinearSystemIsSolvedFromAWrongInverse) {
  constexpr Eigen::Index n = 6;
  const Eigen::MatrixXd A = matrix(n, 0.3);
  const Eigen::MatrixXd inverse = matrix(n, 0.0).inverse();
  Broyden method([&](const Eigen::VectorXd& f) -> Eigen::VectorXd { return inverse * f; });
  const Eigen::VectorXd solution = Eigen::VectorXd::LinSpaced(n, -1.0, 2.0);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(n);
  // D. M. Gay (1979): no more than 2n steps.
  for (Eigen::Index i = 0; i < 2 * n; ++i) {
    const Eigen::VectorXd f = A * (x - solution);
    if (f.norm() < 1e-13) break;
    x += method.step(f);
  }
  EXPECT_LT((x - solution).norm(), 1e-12 * solution.norm());
}

TEST(BranchFactors, ServeAnotherRowInAnotherScaling) {
  constexpr Eigen::Index n = 5;
  BalanceEvaluation at;
  at.jacobian = matrix(n, 0.4);
  at.parameter_derivative = Eigen::VectorXd::LinSpaced(n, 0.5, -1.5);
  at.residual = Eigen::VectorXd::Zero(n);
  const BranchVector made_with{Eigen::VectorXd::LinSpaced(n, 0.1, 0.4), 0.8};
  const BranchVector asked{Eigen::VectorXd::LinSpaced(n, 0.3, -0.2), 0.9};
  const Scaling own{.x = 1e-4, .parameter = 3.0, .residual = 20.0};
  const Scaling other{.x = 2.5e-4, .parameter = 0.7, .residual = 14.0};
  const BranchFactors factors(at, made_with, own);
  const Eigen::VectorXd f = Eigen::VectorXd::LinSpaced(n + 1, -1.0, 1.0);
  for (const Scaling& scaling : {own, other}) {
    const Eigen::VectorXd expected = bordered(at, asked, scaling).lu().solve(f);
    EXPECT_LT((factors.solve(f, asked, scaling) - expected).norm(), 1e-12 * expected.norm());
  }
}

TEST(BranchFactors, TellTheTangentInTheirScalingAndInAnother) {
  constexpr Eigen::Index n = 5;
  NewtonResult solution;
  BalanceEvaluation& at = solution.evaluation;
  at.jacobian = matrix(n, 0.4);
  at.parameter_derivative = Eigen::VectorXd::LinSpaced(n, 0.5, -1.5);
  at.residual = Eigen::VectorXd::Zero(n);
  const BranchVector row{Eigen::VectorXd::LinSpaced(n, 0.1, 0.4), 0.8};
  const Scaling own{.x = 1e-4, .parameter = 3.0, .residual = 20.0};
  const Scaling other{.x = 2.5e-4, .parameter = 0.7, .residual = 14.0};
  solution.factors = std::make_shared<BranchFactors>(at, row, own);
  const BranchVector back{-row.x, -row.parameter};
  for (const Scaling& scaling : {own, other}) {
    for (const BranchVector& previous : {row, back}) {
      const Tangent tangent = tangent_at(solution, previous, scaling);
      EXPECT_GT(dot(tangent.direction, previous), 0.0);
      EXPECT_NEAR(length(tangent.direction), 1.0, 1e-14);
      const Eigen::MatrixXd square = bordered(at, tangent.direction, scaling);
      Eigen::VectorXd y(n + 1);
      y << tangent.direction.x, tangent.direction.parameter;
      EXPECT_LT((square.topRows(n) * y).norm(), 1e-13 * square.norm());
      EXPECT_EQ(tangent.orientation, square.determinant() > 0.0 ? 1.0 : -1.0);
    }
  }
}

}  // namespace
}  // namespace microslip::solver::test_branch_factors
