#include "solver/curve/certificate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "tests/solver/duffing.hpp"

namespace microslip::solver::test_certificate {
namespace {

ResponsePoint certified(const Scene& scene, const Eigen::Vector3d& x, double frequency) {
  HarmonicBalance balance(scene, 1);
  NewtonResult solution;
  solution.point = {x, frequency};
  solution.evaluation = balance.evaluate(x, frequency);
  solution.converged = true;
  return certified_point(balance, solution, frequency, {});
}

// Rounding of forces at rest leaves a motion of 1e-21; damping takes energy from it that nothing
// gives.
TEST(Certificate, WithoutExcitationNoEnergyIsExchanged) {
  const Scene scene = tests::Duffing{.force = 0.0}.scene();
  for (const double frequency : {0.7, 1.0, 1.3}) {
    for (const Eigen::Vector3d& x :
         {Eigen::Vector3d(0.0, 1e-21, 0.0), Eigen::Vector3d(3e-21, -1e-21, 2e-21)}) {
      const ResponsePoint point = certified(scene, x, frequency);
      EXPECT_EQ(point.energy_imbalance, 0.0);
      EXPECT_EQ(point.dissipation_mismatch, 0.0);
    }
  }
}

// A point off the curve is still told by its energy.
TEST(Certificate, AnImbalanceBesideTheExcitationIsTold) {
  const tests::Duffing duffing{.alpha = 0.0};
  const Scene scene = duffing.scene();
  const double frequency = 1.0;  // q = −F/(2ζ) cos θ
  const double amplitude = -duffing.force / (2.0 * duffing.zeta);
  EXPECT_LT(certified(scene, {0.0, 0.0, amplitude}, frequency).energy_imbalance, 1e-14);
  EXPECT_NEAR(certified(scene, {0.0, 0.0, 0.5 * amplitude}, frequency).energy_imbalance, 0.5,
              1e-12);
}

/// On the response curve of the cubic spring, at an amplitude below its peak.
Eigen::Vector3d solution_of(const tests::Duffing& duffing, double amplitude, double frequency) {
  const double elastic = 1.0 - frequency * frequency + 0.75 * duffing.alpha * amplitude * amplitude;
  const std::complex<double> y =
      duffing.force / std::complex<double>(elastic, 2.0 * duffing.zeta * frequency);
  return {0.0, y.real(), y.imag()};
}

/// F(A, ω)² = F² at constant F: dA/dω = −∂F²/∂ω / ∂F²/∂A; phase −atan2(2ζω, 1 − ω² + ¾αA²).
TEST(Certificate, TheSlopeIsThatOfTheClosedForm) {
  const tests::Duffing duffing;
  const Scene scene = duffing.scene();
  const double frequency = 1.2;
  const double amplitude = 2.0;
  // The force that this amplitude takes: the point then lies on the curve.
  tests::Duffing on_curve = duffing;
  on_curve.force = duffing.force * std::sqrt(1.0 + duffing.defect(amplitude, frequency));
  const ResponsePoint point =
      certified(on_curve.scene(), solution_of(on_curve, amplitude, frequency), frequency);
  ASSERT_TRUE(point.slope);
  const double elastic = 1.0 - frequency * frequency + 0.75 * duffing.alpha * amplitude * amplitude;
  const double viscous = 2.0 * duffing.zeta * frequency;
  const double by_frequency =
      4.0 * amplitude * amplitude * (duffing.zeta * viscous - frequency * elastic);
  const double slope = -by_frequency / duffing.slope(amplitude, frequency);
  EXPECT_NEAR(point.amplitude, amplitude, 1e-14);
  EXPECT_NEAR(point.slope->amplitude / slope, 1.0, 1e-12);
  const double elastic_slope = -2.0 * frequency + 1.5 * duffing.alpha * amplitude * slope;
  const double phase_slope = -(2.0 * duffing.zeta * elastic - viscous * elastic_slope) /
                             (elastic * elastic + viscous * viscous);
  EXPECT_NEAR(point.slope->phase / phase_slope, 1.0, 1e-12);
}

TEST(Certificate, RestHasNoSlope) {
  const Scene scene = tests::Duffing{.force = 0.0}.scene();
  EXPECT_FALSE(certified(scene, Eigen::Vector3d::Zero(), 0.9).slope);
}

}  // namespace
}  // namespace microslip::solver::test_certificate
