#include "contact/closed_form/cycle_phases.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/cycle_cases.hpp"

namespace microslip::contact::test_cycle_phases {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

TEST(CyclePhases, RegimesFollowTheirConditions) {
  const auto regime = [](double preload, double u, double v) {
    return cycle_regime(slip_functions({1.0, 1.0, 0.5, preload}, {.u_sin = u, .v_cos = v}));
  };
  EXPECT_EQ(regime(-1.0, 1.0, 1.0), CycleRegime::separated);
  EXPECT_EQ(regime(-0.999, 1.0, 1.0), CycleRegime::separation);
  EXPECT_EQ(regime(0.999, 1.0, 1.0), CycleRegime::separation);
  EXPECT_EQ(regime(1.0, 1.0, 1.0), CycleRegime::stick_slip);
  EXPECT_EQ(regime(100.0, 1.0, 1.0), CycleRegime::full_stick);
  EXPECT_EQ(regime(0.0, 1.0, 0.0), CycleRegime::separated);  // a constant load of nothing
  EXPECT_EQ(regime(1e-9, 0.0, 0.0), CycleRegime::full_stick);
}

// Each phase ends where the next begins, by its direction as well as by its length.
TEST(CyclePhases, LengthsAndDirectionsTellTheSameTime) {
  test::Random random(51);
  for (int i = 0; i < 20000; ++i) {
    const test::CycleCase c = test::generic_case(random);
    const SlipFunctions w = slip_functions(c.point, c.motion);
    const CyclePhases phases = cycle_phases(w, cycle_regime(w));
    double total = 0.0;
    for (int k = 0; k < phases.n_phases; ++k) {
      const CyclePhase& now = phases.phase[static_cast<std::size_t>(k)];
      const CyclePhase& next =
          phases.phase[static_cast<std::size_t>(k + 1 < phases.n_phases ? k + 1 : 0)];
      ASSERT_GE(now.length, 0.0);
      const double end = std::atan2(now.begin.sin, now.begin.cos) + now.length;
      // Roundings of angles and of a few products of sines.
      ASSERT_NEAR(std::sin(end), next.begin.sin, 1e-14);
      ASSERT_NEAR(std::cos(end), next.begin.cos, 1e-14);
      total += now.length;
    }
    if (phases.n_phases > 0) {
      ASSERT_NEAR(total, two_pi, 1e-14);
    }
  }
}

TEST(CyclePhases, StuckAndOpenPointsHaveNone) {
  EXPECT_EQ(cycle_phases(SlipFunctions{}, CycleRegime::separated).n_phases, 0);
  EXPECT_EQ(cycle_phases(SlipFunctions{}, CycleRegime::full_stick).n_phases, 0);
}

// Slip ends at the extremum of its slip function, unless the contact ends first.
TEST(CyclePhases, SlipEndsAtItsExtremum) {
  const SlipFunctions w = slip_functions({1.0, 1.0, 0.5, 2.0},
                                         {.u_sin = 3.0, .u_cos = 1.0, .v_sin = 0.2, .v_cos = -0.7});
  const CyclePhases phases = cycle_phases(w, cycle_regime(w));
  ASSERT_EQ(phases.n_phases, 4);
  EXPECT_EQ(phases.phase[1].kind, PhaseKind::negative_slip);
  EXPECT_EQ(phases.phase[1].to_extremum, phases.phase[1].length);
  EXPECT_EQ(phases.phase[2].begin.sin, w.end_of_negative.sin);
  EXPECT_EQ(phases.phase[0].begin.cos, w.end_of_positive.cos);
}

}  // namespace
}  // namespace microslip::contact::test_cycle_phases
