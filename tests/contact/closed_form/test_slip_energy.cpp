#include "contact/closed_form/slip_energy.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "contact/closed_form/friction_cycle.hpp"

namespace microslip::contact::test_slip_energy {
namespace {

SlipEnergy energy(const PointParameters& point, const PointMotion& motion) {
  const SlipFunctions w = slip_functions(point, motion);
  return slip_energy(point, motion, w, cycle_phases(w, cycle_regime(w)));
}

// Constant load: two phases of 2 (a − q/k_u) each. With a − q = 2⁻⁴⁰ nearly all digits of a formula
// that subtracts are gone; here all are kept.
TEST(SlipEnergy, ShortPhasesKeepTheirDigits) {
  const double off = std::exp2(-40);
  const SlipEnergy e = energy({1.0, 0.0, 0.5, 2.0 * (1.0 - off)}, {.u_sin = 1.0});
  EXPECT_NEAR(e.distance / (4.0 * off), 1.0, 1e-14);  // a dozen roundings
  EXPECT_NEAR(e.normal_slip / (4.0 * off * 2.0 * (1.0 - off)), 1.0, 1e-14);
}

// The whole slip of one phase under a load that grows with it, by Simpson's rule on the slip rate.
// A point that hardly moves and lifts off does no more work than its way under the largest load:
// rounding of the angle of lift-off, squared, is 1e-31 of the load.
TEST(SlipEnergy, NoMotionDoesNoWork) {
  const PointParameters point{1.0, 1.0, 0.5, 0.3};
  for (const double u : {1e-300, 1e-100, 1e-20}) {
    for (const double phase : {0.0, 0.4, 1.1, 2.9}) {
      const PointMotion motion{0.0, u, 0.0, 0.0, std::cos(phase), std::sin(phase)};
      const FrictionCycle cycle = friction_cycle(point, motion);
      EXPECT_EQ(cycle.regime, CycleRegime::separation);
      EXPECT_LE(cycle.dissipated_energy, 0.5 * 1.3 * 4.001 * u);
      EXPECT_LE(cycle.slip_distance, 4.001 * u);
      EXPECT_GE(cycle.dissipated_energy, 0.0);
    }
  }
}

TEST(SlipEnergy, IsTheIntegralOfLoadTimesSlipRate) {
  const PointParameters point{2.0, 1.5, 0.4, 1.0};
  const PointMotion m{.u_sin = 1.4, .u_cos = 0.3, .v_sin = -0.4, .v_cos = 0.9};
  const SlipFunctions w = slip_functions(point, m);
  const CyclePhases phases = cycle_phases(w, cycle_regime(w));
  double work = 0.0;
  for (int i = 0; i < phases.n_phases; ++i) {
    const CyclePhase& phase = phases.phase[static_cast<std::size_t>(i)];
    const double sign = phase.kind == PhaseKind::positive_slip
                            ? 1.0
                            : (phase.kind == PhaseKind::negative_slip ? -1.0 : 0.0);
    const auto rate = [&](double t) {
      const double u = m.u_sin * std::cos(t) - m.u_cos * std::sin(t);
      const double v = m.v_sin * std::cos(t) - m.v_cos * std::sin(t);
      const double n = 1.0 + 1.5 * (m.v_sin * std::sin(t) + m.v_cos * std::cos(t));
      return n * std::abs(u - sign * 0.4 * 1.5 / 2.0 * v);
    };
    constexpr int n = 400;
    const double begin = std::atan2(phase.begin.sin, phase.begin.cos);
    const double h = phase.length / n;
    for (int k = 0; sign != 0.0 && k < n; ++k) {
      const double t = begin + k * h;
      work += h / 6.0 * (rate(t) + 4.0 * rate(t + 0.5 * h) + rate(t + h));
    }
  }
  // Simpson with 400 steps of at most 1/100: h⁴/2880 times fourth derivatives of order ten.
  EXPECT_NEAR(slip_energy(point, m, w, phases).normal_slip, work, 1e-10);
  EXPECT_GT(work, 0.1);
}

// A point that hardly ever slips does so in the last 1/μ of its contact, far from the extremum of
// its slip function. Its work is that of the force over the cycle (theory section 7), which is
// known to ε (k_u a + μ (|n₀| + B)).
TEST(SlipEnergy, SlipJustBeforeLiftOffKeepsItsDigits) {
  for (const double mu : {1e2, 1e3, 1e4, 1e5, 1e6}) {
    const PointParameters point{1.0, 1.0, mu, 0.4};
    const PointMotion m{.u_sin = 1.0, .u_cos = 0.3, .v_sin = -0.5, .v_cos = 1.0};
    const FrictionCycle cycle = friction_cycle(point, m);
    const double work =
        std::numbers::pi * (m.u_sin * cycle.friction.cos - m.u_cos * cycle.friction.sin);
    EXPECT_GT(work, 0.1);
    EXPECT_NEAR(cycle.dissipated_energy, work, 1e-14 * mu * work) << mu;
  }
}

}  // namespace
}  // namespace microslip::contact::test_slip_energy
