/// The exact Jacobian against differences of the coefficients: central away from transitions of
/// regime, one-sided at them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "contact/closed_form/friction_cycle.hpp"
#include "contact/closed_form/slip_functions.hpp"
#include "support/cycle_cases.hpp"

namespace microslip::contact::test_friction_cycle_jacobian {
namespace {

using test::CycleCase;
using test::Random;
using Coefficients = Eigen::Matrix<double, 6, 1>;

Coefficients coefficients(const PointParameters& point, const PointMotion& motion) {
  const FrictionCycle c = friction_cycle(point, motion);
  Coefficients y;
  y << c.friction.mean, c.friction.sin, c.friction.cos, c.normal.mean, c.normal.sin, c.normal.cos;
  return y;
}

double& unknown(PointMotion& m, int k) {
  double* const members[] = {&m.u_mean, &m.u_sin, &m.u_cos, &m.v_mean, &m.v_sin, &m.v_cos};
  return *members[k];
}

Coefficients at_step(const CycleCase& c, int k, double step) {
  PointMotion m = c.motion;
  unknown(m, k) += step;
  return coefficients(c.point, m);
}

// Fourth order in h.
Coefficients central(const CycleCase& c, int k, double h) {
  return (8.0 * (at_step(c, k, h) - at_step(c, k, -h)) -
          (at_step(c, k, 2.0 * h) - at_step(c, k, -2.0 * h))) /
         (12.0 * h);
}

double stiffness_scale(const CycleCase& c) {
  return c.point.tangential_stiffness +
         (1.0 + c.point.friction_coefficient) * c.point.normal_stiffness;
}

// Distance to the nearest change of regime or of sequence, relative to the forces.
bool far_from_kinks(const CycleCase& c) {
  constexpr double far = 0.1;
  const SlipFunctions w = slip_functions(c.point, c.motion);
  const double size = w.positive + w.negative;
  const bool away = std::abs(w.excess) > far * size && w.positive > far * size &&
                    w.negative > far * size && std::abs(w.above_open) > far * w.load_amplitude &&
                    std::abs(w.below_closed) > far * w.load_amplitude;
  const double offset = c.point.tangential_stiffness * c.motion.u_mean;
  const bool unclipped = std::abs(offset - (w.limit - w.positive)) > far * size &&
                         std::abs(offset - (w.negative - w.limit)) > far * size;
  if (!away || !unclipped) {
    return false;
  }
  const FrictionCycle cycle = friction_cycle(c.point, c.motion);
  return std::ranges::all_of(cycle.segments(), [](const auto& s) { return s.length > 0.1; });
}

TEST(FrictionCycleJacobian, AgreesWithCentralDifferencesInEveryRegime) {
  Random random(21);
  int seen[4] = {};
  for (int i = 0; i < 20000; ++i) {
    CycleCase c = test::strata()[2].draw(random);  // comparable sizes of all terms
    if (i % 2 == 0) {
      c = test::generic_case(random);
    }
    if (!far_from_kinks(c)) {
      continue;
    }
    const FrictionCycle cycle = friction_cycle(c.point, c.motion);
    ++seen[static_cast<std::size_t>(cycle.regime)];
    const double u = std::hypot(c.motion.u_sin, c.motion.u_cos);
    const double v = std::hypot(c.motion.v_sin, c.motion.v_cos);
    for (int k = 1; k < 6; ++k) {
      const Coefficients difference = central(c, k, 1e-4 * (k < 3 ? u : v));
      const double error = (difference - cycle.jacobian.col(k)).cwiseAbs().maxCoeff();
      // 1e-7: h⁴ with derivatives that grow like the inverse fifth power of the 0.1 kept from
      // kinks.
      ASSERT_LE(error, 1e-7 * stiffness_scale(c)) << i << " column " << k;
    }
  }
  EXPECT_GT(*std::min_element(std::begin(seen), std::end(seen)), 100);
}

TEST(FrictionCycleJacobian, MeanTangentialColumnActsWhileTheBandDoesNotClip) {
  const PointParameters point{1.0, 1.0, 0.5, 2.4};  // band [0.3, 0.7], see test_friction_cycle
  const auto column = [&](double u_mean) {
    return friction_cycle(point, {.u_mean = u_mean, .u_sin = 1.0, .v_sin = 1.0})
        .jacobian.col(0)
        .eval();
  };
  EXPECT_EQ(column(0.5)[0], 1.0);
  EXPECT_EQ(column(0.1)[0], 0.0);
  EXPECT_EQ(column(0.9)[0], 0.0);
  EXPECT_TRUE(column(0.5).tail(5).isZero(0.0));
}

// At an end of the band the offset is L₂ − q or q − L₁ and follows the motion.
TEST(FrictionCycleJacobian, ClippedOffsetFollowsTheMotion) {
  for (const double u_mean : {0.1, 0.9}) {
    const CycleCase c{{1.0, 1.0, 0.5, 2.4},
                      {.u_mean = u_mean, .u_sin = 1.0, .u_cos = 0.1, .v_sin = 1.0, .v_cos = -0.05}};
    const FrictionCycle cycle = friction_cycle(c.point, c.motion);
    ASSERT_EQ(cycle.regime, CycleRegime::full_stick);
    for (int k = 0; k < 6; ++k) {
      const Coefficients difference = central(c, k, 1e-3);
      // h⁴ times fifth derivatives of a hypot of size 1/2.
      EXPECT_LE((difference - cycle.jacobian.col(k)).cwiseAbs().maxCoeff(), 1e-9) << k;
    }
  }
}

// At the limit of full stick the derivative of either side is its own. On the slip side the
// corrections to it start with the square root of the distance (the angle of slip).
TEST(FrictionCycleJacobian, IsOneSidedAtTheLimitOfFullStick) {
  const PointParameters point{1.0, 1.0, 0.5, 4.0};
  const PointMotion limit{.u_sin = 2.0};  // 2q = L₁ + L₂ = 4 with constant load
  const auto J = [&](double off) {
    PointMotion m = limit;
    m.u_sin *= 1.0 + off;
    return friction_cycle(point, m).jacobian;
  };
  const auto one_sided = [&](double off) {  // ∂/∂u_sin by a difference that stays on one side
    PointMotion near = limit;
    PointMotion far = limit;
    near.u_sin *= 1.0 + off;
    far.u_sin *= 1.0 + 1.01 * off;
    return ((coefficients(point, far) - coefficients(point, near)) / (far.u_sin - near.u_sin))
        .eval();
  };
  for (const double off : {-1e-6, 1e-6}) {
    // √off = 1e-3 is the scale of the change across the difference's 1 %.
    EXPECT_LE((one_sided(off) - J(1.005 * off).col(1)).cwiseAbs().maxCoeff(), 2e-5) << off;
  }
  EXPECT_EQ(J(-1e-6)(1, 1), 1.0);                            // a spring
  EXPECT_NEAR(J(1e-6)(2, 1), 4.0 / std::numbers::pi, 1e-2);  // ∂f_c/∂a jumps from 0 to 4q/(πa)·…
  EXPECT_EQ(J(-1e-6)(2, 1), 0.0);
}

// Touch-down moves with the load: the memory of a stick phase after separation carries a derivative
// that a frozen instant would miss.
TEST(FrictionCycleJacobian, StickAfterSeparationRemembersTheMotionOfTouchDown) {
  CycleCase c{{1.0, 1.0, 2.0, 0.2}, {.u_sin = 0.3, .u_cos = 0.2, .v_sin = 1.0, .v_cos = 0.0}};
  const FrictionCycle cycle = friction_cycle(c.point, c.motion);
  ASSERT_EQ(cycle.regime, CycleRegime::separation);
  bool stick_after_open = false;
  const auto s = cycle.segments();
  for (std::size_t i = 0; i < s.size(); ++i) {
    stick_after_open = stick_after_open || (s[i].state == ContactState::separated &&
                                            s[(i + 1) % s.size()].state == ContactState::stick);
  }
  ASSERT_TRUE(stick_after_open);
  for (int k = 0; k < 6; ++k) {
    // h⁴ = 1e-12 times derivatives of order one to a hundred.
    EXPECT_LE((central(c, k, 1e-3) - cycle.jacobian.col(k)).cwiseAbs().maxCoeff(), 1e-9) << k;
  }
}

}  // namespace
}  // namespace microslip::contact::test_friction_cycle_jacobian
