#include "solver/balance/period_energy.hpp"

#include <numbers>

#include <gtest/gtest.h>

#include "tests/solver/duffing.hpp"

namespace microslip::solver::test_period_energy {
namespace {

// At resonance q = −F/(2ζ) cos θ: the force F sin θ gives π F a, all of which damping takes.
TEST(PeriodEnergy, OfALinearResonanceIsThatOfItsDamping) {
  const tests::Duffing duffing{.alpha = 0.0};
  const Scene scene = duffing.scene();
  const double amplitude = duffing.force / (2.0 * duffing.zeta);
  HarmonicBalance balance(scene, HarmonicSet(1));
  const PeriodEnergy energy = period_energy(balance, Eigen::Vector3d(0.0, 0.0, -amplitude), 1.0);
  const double expected = std::numbers::pi * duffing.force * amplitude;
  EXPECT_NEAR(energy.damping, expected, 1e-12 * expected);
  EXPECT_NEAR(energy.friction, 0.0, 1e-12 * expected);
}

}  // namespace
}  // namespace microslip::solver::test_period_energy
