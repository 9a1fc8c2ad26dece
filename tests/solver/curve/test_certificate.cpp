#include "solver/curve/certificate.hpp"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace microslip::solver::test_certificate
