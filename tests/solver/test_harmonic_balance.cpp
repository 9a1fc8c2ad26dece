#include "solver/harmonic_balance.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/random_scene.hpp"

namespace microslip::solver {
namespace {

/// A motion of the size of the stuck response, on no symmetry.
Eigen::VectorXd some_motion(const HarmonicBalance& balance, double omega) {
  Eigen::VectorXd x = balance.linear_response(omega, balance.stuck_stiffness());
  const double size = x.cwiseAbs().maxCoeff();
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    x[i] += 0.3 * size * std::sin(1.7 * static_cast<double>(i) + 0.3);
  }
  return x;
}

TEST(HarmonicBalance, JacobianIsTheDifferenceOfResiduals) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const auto random = tests::random_scene(seed);
    const HarmonicBalance balance(random.scene, 1);
    const double omega = 1.1 * random.options.frequency_begin;
    const Eigen::VectorXd x = some_motion(balance, omega);
    const auto at = balance.evaluate(x, omega);
    const double h = 1e-6 * x.norm();
    const double scale = at.jacobian.cwiseAbs().maxCoeff();
    Eigen::Index far = 0;
    for (Eigen::Index j = 0; j < x.size(); ++j) {
      const Eigen::VectorXd step = h * Eigen::VectorXd::Unit(x.size(), j);
      const Eigen::VectorXd difference =
          (balance.evaluate(x + step, omega).residual - balance.evaluate(x - step, omega).residual) /
          (2.0 * h);
      // A kink of one of the points inside the step shows as h times its curvature at most.
      if ((difference - at.jacobian.col(j)).cwiseAbs().maxCoeff() > 1e-5 * scale) ++far;
    }
    EXPECT_EQ(far, 0) << "seed " << seed;
  }
}

TEST(HarmonicBalance, FrequencyDerivativeIsTheDifferenceOfResiduals) {
  const auto random = tests::random_scene(3);
  const HarmonicBalance balance(random.scene, 1);
  const double omega = 1.1 * random.options.frequency_begin;
  const Eigen::VectorXd x = some_motion(balance, omega);
  const double h = 1e-5 * omega;
  const Eigen::VectorXd difference =
      (balance.evaluate(x, omega + h).residual - balance.evaluate(x, omega - h).residual) / (2.0 * h);
  const auto at = balance.evaluate(x, omega);
  EXPECT_LT((difference - at.parameter_derivative).norm(), 1e-9 * at.parameter_derivative.norm());
}

TEST(HarmonicBalance, LinearResponseSolvesTheFreeAndTheStuckEquations) {
  const auto random = tests::random_scene(5);
  const HarmonicBalance balance(random.scene, 1);
  const double omega = 1.2 * random.options.frequency_begin;
  const Eigen::Index n = random.scene.n_modes();
  const Eigen::VectorXd x = balance.linear_response(omega, Eigen::MatrixXd::Zero(n, n));
  const Eigen::VectorXd residual = balance.linear_operator(omega) * x - balance.excitation();
  EXPECT_LT(residual.norm(), 1e-12 * balance.excitation().norm());
}

TEST(HarmonicBalance, HomotopyEndsAtTheLinearLimitAndAtTheContact) {
  const auto random = tests::random_scene(7);
  const HarmonicBalance balance(random.scene, 1);
  const double omega = 1.2 * random.options.frequency_begin;
  const Eigen::VectorXd x = balance.linear_response(omega, balance.stuck_stiffness());
  const double scale = balance.force_scale(omega);
  EXPECT_LT(balance.evaluate_homotopy(x, omega, 0.0, balance.stuck_stiffness()).residual.norm(),
            1e-11 * scale);
  EXPECT_EQ(balance.evaluate_homotopy(x, omega, 1.0, balance.stuck_stiffness()).residual,
            balance.evaluate(x, omega).residual);
}

TEST(HarmonicBalance, RefusesScenesWhoseSizesDiffer) {
  auto random = tests::random_scene(1);
  random.scene.output.conservativeResize(random.scene.n_modes() + 1);
  EXPECT_THROW(HarmonicBalance(random.scene, 1), std::invalid_argument);
}

}  // namespace
}  // namespace microslip::solver
