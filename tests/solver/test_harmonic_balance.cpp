#include "solver/harmonic_balance.hpp"

#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "solver/linear_force.hpp"
#include "tests/support/modal_scenes.hpp"

namespace microslip::solver {
namespace {

/// A motion that makes some points of the patch slip and others separate.
Eigen::VectorXd some_motion(Eigen::Index size, double scale) {
  Eigen::VectorXd x(size);
  for (Eigen::Index i = 0; i < size; ++i)
    x[i] = scale * std::cos(2.3 * static_cast<double>(i) + 0.4);
  return x;
}

/// A linear scene with two harmonics.
Scene two_harmonics() {
  Scene scene;
  scene.natural_frequency = Eigen::Vector3d(1.0, 2.5, 0.0);
  scene.damping_ratio = Eigen::Vector3d(0.01, 0.2, 0.3);
  scene.output = Eigen::Vector3d(1.0, 0.5, -0.3);
  scene.excitation = Harmonics(2, 3);
  scene.excitation.vector() = some_motion(15, 1.0);
  Eigen::Matrix3d stiffness;
  stiffness << 2.0, 0.3, 0.1, 0.3, 1.0, -0.2, 0.1, -0.2, 0.5;
  scene.contact = std::make_unique<LinearForce>(stiffness, contact::CycleReport{1.0, 0.0, 0.0});
  return scene;
}

void expect_jacobian(const HarmonicBalance& balance, const Eigen::VectorXd& x, double omega) {
  const BalanceEvaluation at = balance.evaluate(x, omega);
  // Central differences: h² of truncation against eps/h of rounding; kinks of a sum of points are
  // mild.
  const double h = 1e-6 * x.norm();
  const double scale = at.jacobian.norm();
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const Eigen::VectorXd step = h * Eigen::VectorXd::Unit(x.size(), i);
    const Eigen::VectorXd slope =
        (balance.evaluate(x + step, omega).residual - balance.evaluate(x - step, omega).residual) /
        (2.0 * h);
    EXPECT_LT((slope - at.jacobian.col(i)).norm(), 1e-6 * scale) << "column " << i;
  }
  const double d = 1e-6 * omega;
  const Eigen::VectorXd slope =
      (balance.evaluate(x, omega + d).residual - balance.evaluate(x, omega - d).residual) /
      (2.0 * d);
  // Rounding of the contact force, which does not cancel: eps ‖K x‖ / d.
  EXPECT_LT((slope - at.parameter_derivative).norm(),
            1e-6 * at.parameter_derivative.norm() + 1e-9 * scale * x.norm() / omega);
}

TEST(HarmonicBalance, JacobianIsTheDerivativeForAPatchThatSlipsAndSeparates) {
  const Scene scene = tests::patch_scene({4, 60}, 800.0);
  const HarmonicBalance balance(scene, 1);
  const Eigen::VectorXd x = some_motion(balance.size(), 8e-5);
  const auto report = scene.contact->report(balance.harmonics(x), 1.0);
  ASSERT_GT(report.slip_share, 0.05);
  ASSERT_GT(report.separated_share, 0.05);
  expect_jacobian(balance, x, 1900.0);
}

TEST(HarmonicBalance, JacobianIsTheDerivativeForACubicSpring) {
  const Scene scene = tests::Duffing{}.scene();
  expect_jacobian(HarmonicBalance(scene, 1), Eigen::Vector3d(0.3, -1.2, 0.7), 1.1);
}

TEST(HarmonicBalance, JacobianIsTheDerivativeForTwoHarmonics) {
  const Scene scene = two_harmonics();
  const HarmonicBalance balance(scene, 2);
  expect_jacobian(balance, some_motion(balance.size(), 1.0), 0.8);
}

TEST(HarmonicBalance, LinearPartIsTheComplexImpedanceOfEachHarmonic) {
  const Scene scene = two_harmonics();
  const HarmonicBalance balance(scene, 2);
  const double omega = 1.3;
  const Eigen::VectorXd x = some_motion(balance.size(), 1.0);
  const Harmonics q = balance.harmonics(x);
  const Harmonics force = balance.harmonics(balance.linear_operator(omega) * x);
  using Complex = std::complex<double>;
  for (int k = 1; k <= 2; ++k) {
    for (Eigen::Index n = 0; n < 3; ++n) {
      const double natural = scene.natural_frequency[n];
      const Complex impedance(natural * natural - k * k * omega * omega,
                              2.0 * scene.damping_ratio[n] * natural * k * omega);
      const Complex expected = impedance * Complex(q.sine(k)[n], q.cosine(k)[n]);
      EXPECT_NEAR(force.sine(k)[n], expected.real(), 1e-14 * std::abs(impedance));
      EXPECT_NEAR(force.cosine(k)[n], expected.imag(), 1e-14 * std::abs(impedance));
    }
  }
}

TEST(HarmonicBalance, LinearResponseLeavesNoResidual) {
  const Scene scene = two_harmonics();
  const HarmonicBalance balance(scene, 2);
  const Eigen::VectorXd x = balance.linear_response(0.7, scene.contact->stuck_stiffness());
  EXPECT_LT(balance.evaluate(x, 0.7).residual.norm(), 1e-13 * balance.excitation().norm());
}

TEST(HarmonicBalance, HomotopyGoesFromTheLinearLimitToTheContact) {
  const Scene scene = tests::patch_scene({3, 20}, 800.0);
  const HarmonicBalance balance(scene, 1);
  const Eigen::VectorXd x = some_motion(balance.size(), 2e-5);
  const Eigen::MatrixXd& stuck = balance.stuck_stiffness();
  const auto whole = balance.evaluate_homotopy(x, 1900.0, 1.0, stuck);
  EXPECT_EQ(whole.residual, balance.evaluate(x, 1900.0).residual);
  const Eigen::VectorXd linear = balance.linear_response(1900.0, stuck);
  const auto none = balance.evaluate_homotopy(linear, 1900.0, 0.0, stuck);
  EXPECT_LT(none.residual.norm(), 1e-13 * balance.force_scale(1900.0));
  const auto half = balance.evaluate_homotopy(x, 1900.0, 0.5, stuck);
  const auto less = balance.evaluate_homotopy(x, 1900.0, 0.25, stuck);
  EXPECT_LT((half.residual - less.residual - 0.25 * half.parameter_derivative).norm(),
            1e-13 * half.parameter_derivative.norm());
}

TEST(HarmonicBalance, RefusesScenesThatDoNotFitTogether) {
  Scene scene = two_harmonics();
  EXPECT_THROW(HarmonicBalance(scene, 0), std::invalid_argument);
  scene.output.resize(2);
  EXPECT_THROW(HarmonicBalance(scene, 1), std::invalid_argument);
  scene = two_harmonics();
  scene.natural_frequency[1] = -1.0;
  EXPECT_THROW(HarmonicBalance(scene, 1), std::invalid_argument);
  scene = two_harmonics();
  scene.excitation.rows()(1, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(HarmonicBalance(scene, 1), std::invalid_argument);
  scene = two_harmonics();
  scene.contact = std::make_unique<tests::CubicSpring>(1.0);
  EXPECT_THROW(HarmonicBalance(scene, 1), std::invalid_argument);
}

}  // namespace
}  // namespace microslip::solver
