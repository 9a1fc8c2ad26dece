#include "solver/balance/harmonic_balance.hpp"

#include <cmath>
#include <complex>
#include <memory>

#include <gtest/gtest.h>

#include "solver/balance/linear_force.hpp"
#include "tests/support/modal_scenes.hpp"
#include "tests/support/random_scene.hpp"

namespace microslip::solver::test_harmonic_balance {
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
    HarmonicBalance balance(random.scene, 1);
    const double omega = 1.1 * random.options.frequency_begin;
    const Eigen::VectorXd x = some_motion(balance, omega);
    const auto at = balance.evaluate(x, omega);
    const double h = 1e-6 * x.norm();
    const double scale = at.jacobian.dense().cwiseAbs().maxCoeff();
    Eigen::Index far = 0;
    for (Eigen::Index j = 0; j < x.size(); ++j) {
      const Eigen::VectorXd step = h * Eigen::VectorXd::Unit(x.size(), j);
      const Eigen::VectorXd difference = (balance.evaluate(x + step, omega).residual -
                                          balance.evaluate(x - step, omega).residual) /
                                         (2.0 * h);
      // A kink of one of the points inside the step shows as h times its curvature at most.
      if ((difference - at.jacobian.dense().col(j)).cwiseAbs().maxCoeff() > 1e-5 * scale) ++far;
    }
    EXPECT_EQ(far, 0) << "seed " << seed;
  }
}

TEST(HarmonicBalance, FrequencyDerivativeIsTheDifferenceOfResiduals) {
  const auto random = tests::random_scene(3);
  HarmonicBalance balance(random.scene, 1);
  const double omega = 1.1 * random.options.frequency_begin;
  const Eigen::VectorXd x = some_motion(balance, omega);
  const double h = 1e-5 * omega;
  const Eigen::VectorXd difference =
      (balance.evaluate(x, omega + h).residual - balance.evaluate(x, omega - h).residual) /
      (2.0 * h);
  const auto at = balance.evaluate(x, omega);
  EXPECT_LT((difference - at.parameter_derivative).norm(), 1e-9 * at.parameter_derivative.norm());
}

/// L x − Q
Eigen::VectorXd free_residual(HarmonicBalance& balance, const Eigen::VectorXd& x, double omega) {
  const Eigen::Index n = balance.scene().n_modes();
  return balance.evaluate_homotopy(x, omega, 0.0, Eigen::MatrixXd::Zero(n, n)).residual;
}

// Row 81. Hard: a step of Newton's method to a frequency below 0, where friction would grow.
// Met in: friction that falls with the speed.
// Right: refused: there is no such excitation.
TEST(HarmonicBalance, NothingIsSolvedBelowZeroFrequency) {
  const auto random = tests::random_scene(3);
  HarmonicBalance balance(random.scene, 1);
  const Eigen::VectorXd x = some_motion(balance, random.options.frequency_begin);
  EXPECT_TRUE(balance.evaluate(x, 0.0).residual.allFinite());
  EXPECT_FALSE(std::isfinite(balance.evaluate(x, -1e-300).residual.norm()));
  EXPECT_FALSE(std::isfinite(balance.residual(x, -1.0).residual.norm()));
}

TEST(HarmonicBalance, LinearResponseSolvesTheFreeAndTheStuckEquations) {
  const auto random = tests::random_scene(5);
  HarmonicBalance balance(random.scene, 1);
  const double omega = 1.2 * random.options.frequency_begin;
  const Eigen::Index n = random.scene.n_modes();
  const Eigen::VectorXd x = balance.linear_response(omega, Eigen::MatrixXd::Zero(n, n));
  EXPECT_LT(free_residual(balance, x, omega).norm(), 1e-12 * balance.excitation().norm());
}

TEST(HarmonicBalance, HomotopyEndsAtTheLinearLimitAndAtTheContact) {
  const auto random = tests::random_scene(7);
  HarmonicBalance balance(random.scene, 1);
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

/// Numbers of order one on no symmetry.
Eigen::VectorXd wave(Eigen::Index size) {
  Eigen::VectorXd x(size);
  for (Eigen::Index i = 0; i < size; ++i) x[i] = std::cos(2.3 * static_cast<double>(i) + 0.4);
  return x;
}

/// A linear scene with two harmonics.
Scene two_harmonics() {
  Scene scene;
  scene.natural_frequency = Eigen::Vector3d(1.0, 2.5, 0.0);
  scene.damping_ratio = Eigen::Vector3d(0.01, 0.2, 0.3);
  scene.output = Eigen::Vector3d(1.0, 0.5, -0.3);
  scene.excitation = Harmonics(2, 3);
  scene.excitation.vector() = wave(15);
  Eigen::Matrix3d stiffness;
  stiffness << 2.0, 0.3, 0.1, 0.3, 1.0, -0.2, 0.1, -0.2, 0.5;
  scene.contact = std::make_unique<LinearForce>(stiffness, contact::CycleReport{1.0, 0.0, 0.0});
  return scene;
}

TEST(HarmonicBalance, JacobianOfTwoHarmonicsIsTheDifferenceOfResiduals) {
  const Scene scene = two_harmonics();
  HarmonicBalance balance(scene, 2);
  const Eigen::VectorXd x = wave(balance.size());
  const auto at = balance.evaluate(x, 0.8);
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const Eigen::VectorXd step = Eigen::VectorXd::Unit(x.size(), i);  // linear: any step is exact
    const Eigen::VectorXd difference = balance.evaluate(x + step, 0.8).residual - at.residual;
    EXPECT_LT((difference - at.jacobian.dense().col(i)).norm(), 1e-13 * at.jacobian.dense().norm());
  }
  const double h = 1e-6;
  const Eigen::VectorXd difference =
      (balance.evaluate(x, 0.8 + h).residual - balance.evaluate(x, 0.8 - h).residual) / (2.0 * h);
  EXPECT_LT((difference - at.parameter_derivative).norm(), 1e-8 * at.parameter_derivative.norm());
}

TEST(HarmonicBalance, LinearPartIsTheComplexImpedanceOfEachHarmonic) {
  const Scene scene = two_harmonics();
  HarmonicBalance balance(scene, 2);
  const double omega = 1.3;
  const Eigen::VectorXd x = wave(balance.size());
  const Harmonics q = balance.harmonics(x);
  const Harmonics force =
      balance.harmonics(free_residual(balance, x, omega) + balance.excitation());
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

Scene event_scene() {
  Scene scene = tests::three_dof_scene(30.0);
  tests::use_event_cycles(scene);
  return scene;
}

TEST(HarmonicBalance, ASetLeavesOutRowsAndColumnsOfTheWhole) {
  const Scene scene = event_scene();
  HarmonicBalance whole(scene, 5);
  HarmonicBalance odd(scene, HarmonicSet(std::vector<int>{1, 3, 5}));
  const double omega = 130.0;
  const Eigen::VectorXd x = some_motion(odd, omega);
  const Eigen::VectorXd wide = whole.unknowns(odd.harmonics(x));
  ASSERT_EQ(odd.size(), 14);  // 2 modes, mean and three harmonics
  EXPECT_EQ(odd.unknowns(whole.harmonics(wide)), x);
  const auto all = whole.evaluate(wide, omega);
  const auto some = odd.evaluate(x, omega);
  EXPECT_EQ(some.residual, odd.unknowns(all.residual));
  EXPECT_EQ(some.parameter_derivative, odd.unknowns(all.parameter_derivative));
  for (Eigen::Index j = 0; j < x.size(); ++j) {
    const Eigen::VectorXd step = Eigen::VectorXd::Unit(x.size(), j);
    const Eigen::VectorXd column = all.jacobian.dense() * whole.unknowns(odd.harmonics(step));
    EXPECT_EQ(some.jacobian.dense().col(j), odd.unknowns(column)) << j;
  }
}

TEST(HarmonicBalance, JacobianOfASetIsTheDifferenceOfResiduals) {
  const Scene scene = event_scene();
  HarmonicBalance balance(scene, HarmonicSet(std::vector<int>{1, 2, 5}));
  const double omega = 130.0;
  const Eigen::VectorXd x = some_motion(balance, omega);
  const auto at = balance.evaluate(x, omega);
  const double h = 1e-6 * x.norm();
  for (Eigen::Index j = 0; j < x.size(); ++j) {
    const Eigen::VectorXd step = h * Eigen::VectorXd::Unit(x.size(), j);
    const Eigen::VectorXd difference =
        (balance.evaluate(x + step, omega).residual - balance.evaluate(x - step, omega).residual) /
        (2.0 * h);
    // Central differences err by h² times the third derivative, 1e-12 of the scale, and by
    // rounding, 1e-16 / 1e-6 of it; transitions move by h between the two sides, which the square
    // root of section 4.5 enlarges.
    EXPECT_LT((difference - at.jacobian.dense().col(j)).norm(), 1e-5 * at.jacobian.dense().norm())
        << j;
  }
}

}  // namespace
}  // namespace microslip::solver::test_harmonic_balance
