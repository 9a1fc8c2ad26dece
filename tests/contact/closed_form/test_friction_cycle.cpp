/// Closed-form facts of one point (theory sections 4, 5, 7) and its invariances.
#include "contact/closed_form/friction_cycle.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "support/cycle_cases.hpp"

namespace microslip::contact::test_friction_cycle {
namespace {

using test::CycleCase;
using test::Random;

constexpr double pi = std::numbers::pi;
// Sums of about a dozen terms of the size of the scale, each rounded at 1.1e-16.
constexpr double rounding = 4e-15;

std::vector<double> coefficients(const FrictionCycle& cycle) {
  return {cycle.friction.mean, cycle.friction.sin, cycle.friction.cos,
          cycle.normal.mean,   cycle.normal.sin,   cycle.normal.cos};
}

TEST(FrictionCycle, ConstantLoadGivesTheClassicalLoop) {
  const double k_u = 3.0;
  const double a = 2.0;
  const double q = 1.7;  // μ n₀ < k_u a
  const FrictionCycle cycle = friction_cycle({k_u, 0.0, 0.5, q / 0.5}, {.u_mean = 9.0, .u_sin = a});
  const double psi = 2.0 * std::atan2(std::sqrt(q), std::sqrt(k_u * a - q));
  EXPECT_EQ(cycle.regime, CycleRegime::stick_slip);
  EXPECT_NEAR(cycle.friction.mean, 0.0, rounding * k_u * a);
  EXPECT_NEAR(cycle.friction.sin, k_u * a / pi * (psi - 0.5 * std::sin(2.0 * psi)),
              rounding * k_u * a);
  EXPECT_NEAR(cycle.friction.cos, 4.0 * q * (1.0 - q / (k_u * a)) / pi, rounding * k_u * a);
  EXPECT_NEAR(cycle.dissipated_energy, 4.0 * q * (a - q / k_u), rounding * k_u * a * a);
  EXPECT_NEAR(cycle.slip_distance, 4.0 * (a - q / k_u), rounding * a);
}

TEST(FrictionCycle, StuckPointIsASpringAndDissipatesNothing) {
  const FrictionCycle cycle = friction_cycle(
      {2.0, 3.0, 0.5, 100.0}, {.u_mean = 0.25, .u_sin = 1.0, .u_cos = -2.0, .v_sin = 0.5});
  EXPECT_EQ(cycle.regime, CycleRegime::full_stick);
  ASSERT_EQ(cycle.segments().size(), 1U);
  EXPECT_EQ(cycle.segments()[0].state, ContactState::stick);
  EXPECT_EQ(cycle.segments()[0].start, 0.0);
  EXPECT_EQ(cycle.segments()[0].length, 2.0 * pi);
  EXPECT_EQ(cycle.friction.mean, 0.5);  // k_u u₀: the slider rests at 0
  EXPECT_EQ(cycle.friction.sin, 2.0);
  EXPECT_EQ(cycle.friction.cos, -4.0);
  EXPECT_EQ(cycle.normal.sin, 1.5);
  EXPECT_EQ(cycle.dissipated_energy, 0.0);
  EXPECT_EQ(cycle.slip_distance, 0.0);
}

// Theory section 4.2: in-phase motion with μ k_v b = k_u a / 2 and μ n₀ = 1.2 k_u a: the offset
// must lie in [0.3, 0.7] k_u a, so that even a stuck point carries a mean force.
TEST(FrictionCycle, StuckPointUnderVaryingLoadCarriesAMeanForce) {
  const PointParameters point{1.0, 1.0, 0.5, 2.4};
  EXPECT_NEAR(friction_cycle(point, {.u_sin = 1.0, .v_sin = 1.0}).friction.mean, 0.3, rounding);
  EXPECT_NEAR(friction_cycle(point, {.u_mean = 0.5, .u_sin = 1.0, .v_sin = 1.0}).friction.mean, 0.5,
              rounding);
  EXPECT_NEAR(friction_cycle(point, {.u_mean = 9.0, .u_sin = 1.0, .v_sin = 1.0}).friction.mean, 0.7,
              rounding);
}

TEST(FrictionCycle, OpenPointCarriesNothing) {
  const FrictionCycle cycle =
      friction_cycle({2.0, 3.0, 0.5, -1.6}, {.u_sin = 1.0, .v_sin = 0.5, .v_cos = 0.1});
  EXPECT_EQ(cycle.regime, CycleRegime::separated);
  ASSERT_EQ(cycle.segments().size(), 1U);
  EXPECT_EQ(cycle.segments()[0].state, ContactState::separated);
  for (const double coefficient : coefficients(cycle)) {
    EXPECT_EQ(coefficient, 0.0);
  }
  EXPECT_EQ(cycle.jacobian, CycleJacobian::Zero().eval());
}

TEST(FrictionCycle, HalfWaveLoadHasItsFourierCoefficients) {
  // n = max(0, sin θ): mean 1/π, sine ½.
  const FrictionCycle cycle = friction_cycle({1.0, 1.0, 0.0, 0.0}, {.v_sin = 1.0});
  EXPECT_NEAR(cycle.normal.mean, 1.0 / pi, rounding);
  EXPECT_NEAR(cycle.normal.sin, 0.5, rounding);
  EXPECT_NEAR(cycle.normal.cos, 0.0, rounding);
}

TEST(FrictionCycle, BothSlipPhasesCoverTheSameDistanceWithoutSeparation) {
  Random random(3);
  int seen = 0;
  for (int i = 0; i < 2000; ++i) {
    const CycleCase c = test::generic_case(random);
    const FrictionCycle cycle = friction_cycle(c.point, c.motion);
    if (cycle.regime != CycleRegime::stick_slip) {
      continue;
    }
    ++seen;
    double moved[2] = {};
    for (const CycleSegment& s : cycle.segments()) {
      if (s.state == ContactState::positive_slip || s.state == ContactState::negative_slip) {
        const auto slider = [&](double phase) {
          const double n =
              c.point.rest_load +
              c.point.normal_stiffness * (c.motion.v_mean + c.motion.v_sin * std::sin(phase) +
                                          c.motion.v_cos * std::cos(phase));
          const double sign = s.state == ContactState::positive_slip ? 1.0 : -1.0;
          return c.motion.u_sin * std::sin(phase) + c.motion.u_cos * std::cos(phase) -
                 sign * c.point.friction_coefficient * n / c.point.tangential_stiffness;
        };
        moved[s.state == ContactState::positive_slip ? 0 : 1] +=
            slider(s.start + s.length) - slider(s.start);
      }
    }
    const double scale = test::friction_scale(c) / c.point.tangential_stiffness;
    ASSERT_NEAR(moved[0], -moved[1], rounding * scale);
    ASSERT_NEAR(moved[0] - moved[1], cycle.slip_distance, rounding * scale);
  }
  EXPECT_GT(seen, 200);
}

TEST(FrictionCycle, WorkOfTheForceIsWorkOfSlipAndTheNormalForceDoesNone) {
  Random random(4);
  for (const test::Stratum& stratum : test::strata()) {
    for (int i = 0; i < 2000; ++i) {
      const CycleCase c = stratum.draw(random);
      const FrictionCycle cycle = friction_cycle(c.point, c.motion);
      const PointMotion& m = c.motion;
      const double work = pi * (m.u_sin * cycle.friction.cos - m.u_cos * cycle.friction.sin);
      const double a = std::hypot(m.u_sin, m.u_cos);
      const double f = test::friction_scale(c);
      // Slip goes as far as the force over the stiffness even where u does not (μ n varies).
      const double slip = c.point.tangential_stiffness > 0.0 ? f / c.point.tangential_stiffness : a;
      const double subnormal = 1e-320;  // spacing of the smallest numbers, with a margin
      ASSERT_NEAR(work, cycle.dissipated_energy, 8.0 * rounding * f * slip + subnormal)
          << stratum.name;
      const double normal_work = m.v_sin * cycle.normal.cos - m.v_cos * cycle.normal.sin;
      ASSERT_NEAR(normal_work, 0.0,
                  rounding * test::normal_scale(c) * std::hypot(m.v_sin, m.v_cos) + subnormal)
          << stratum.name;
    }
  }
}

TEST(FrictionCycle, ShiftInPhaseTurnsTheCoefficients) {
  Random random(5);
  for (int i = 0; i < 5000; ++i) {
    const CycleCase c = test::generic_case(random);
    const double s = std::sin(0.1 * i);
    const double k = std::cos(0.1 * i);
    const PointMotion& m = c.motion;
    const PointMotion turned{m.u_mean, k * m.u_sin - s * m.u_cos, s * m.u_sin + k * m.u_cos,
                             m.v_mean, k * m.v_sin - s * m.v_cos, s * m.v_sin + k * m.v_cos};
    const FrictionCycle a = friction_cycle(c.point, m);
    const FrictionCycle b = friction_cycle(c.point, turned);
    const double f = 2.0 * rounding * test::friction_scale(c);  // inputs are rounded as well
    const double n = 2.0 * rounding * test::normal_scale(c);
    ASSERT_NEAR(b.friction.mean, a.friction.mean, f);
    ASSERT_NEAR(b.friction.sin, k * a.friction.sin - s * a.friction.cos, f);
    ASSERT_NEAR(b.friction.cos, s * a.friction.sin + k * a.friction.cos, f);
    ASSERT_NEAR(b.normal.mean, a.normal.mean, n);
    ASSERT_NEAR(b.normal.sin, k * a.normal.sin - s * a.normal.cos, n);
    ASSERT_NEAR(b.normal.cos, s * a.normal.sin + k * a.normal.cos, n);
  }
}

TEST(FrictionCycle, ReversalOfTheTangentialMotionReversesFriction) {
  Random random(6);
  for (int i = 0; i < 5000; ++i) {
    const CycleCase c = test::generic_case(random);
    PointMotion reversed = c.motion;
    reversed.u_mean = -reversed.u_mean;
    reversed.u_sin = -reversed.u_sin;
    reversed.u_cos = -reversed.u_cos;
    const FrictionCycle a = friction_cycle(c.point, c.motion);
    const FrictionCycle b = friction_cycle(c.point, reversed);
    const double f = rounding * test::friction_scale(c);
    ASSERT_NEAR(b.friction.mean, -a.friction.mean, f);
    ASSERT_NEAR(b.friction.sin, -a.friction.sin, f);
    ASSERT_NEAR(b.friction.cos, -a.friction.cos, f);
    ASSERT_EQ(b.normal.mean, a.normal.mean);
    ASSERT_EQ(b.segments().size(), a.segments().size());
    for (std::size_t k = 0; k < a.segments().size(); ++k) {
      const ContactState state = a.segments()[k].state;
      const ContactState mirrored =
          state == ContactState::positive_slip
              ? ContactState::negative_slip
              : (state == ContactState::negative_slip ? ContactState::positive_slip : state);
      ASSERT_EQ(b.segments()[k].state, mirrored);
    }
  }
}

CycleCase scaled(CycleCase c, double factor) {
  for (double* x : {&c.point.rest_load, &c.motion.u_mean, &c.motion.u_sin, &c.motion.u_cos,
                    &c.motion.v_mean, &c.motion.v_sin, &c.motion.v_cos}) {
    *x *= factor;
  }
  return c;
}

RC_GTEST_PROP(FrictionCycleProperty, PowersOfTwoScaleBitByBit, (std::uint32_t seed)) {
  Random random(seed);
  const CycleCase c = test::generic_case(random);
  const double factor = std::exp2(*rc::gen::resize(100, rc::gen::inRange(-60, 60)));
  const CycleCase d = scaled(c, factor);
  const FrictionCycle a = friction_cycle(c.point, c.motion);
  const FrictionCycle b = friction_cycle(d.point, d.motion);
  for (std::size_t k = 0; k < 6; ++k) {
    RC_ASSERT(coefficients(b)[k] == factor * coefficients(a)[k]);
  }
  RC_ASSERT(a.jacobian == b.jacobian);
  RC_ASSERT(b.dissipated_energy == factor * factor * a.dissipated_energy);
}

// M10: μ × c with (n₀, k_v) / c leaves the tangential force; bit by bit for powers of two.
RC_GTEST_PROP(FrictionCycleProperty, FrictionKnowsOnlyTheProductOfMuAndLoad, (std::uint32_t seed)) {
  Random random(seed);
  const CycleCase c = test::generic_case(random);
  const double factor = std::exp2(*rc::gen::resize(100, rc::gen::inRange(-20, 20)));
  PointParameters other = c.point;
  other.friction_coefficient *= factor;
  other.normal_stiffness /= factor;
  other.rest_load /= factor;
  const FrictionCycle a = friction_cycle(c.point, c.motion);
  const FrictionCycle b = friction_cycle(other, c.motion);
  RC_ASSERT(a.friction.mean == b.friction.mean);
  RC_ASSERT(a.friction.sin == b.friction.sin);
  RC_ASSERT(a.friction.cos == b.friction.cos);
}

RC_GTEST_PROP(FrictionCycleProperty, MeanTangentialDisplacementActsInFullStickOnly,
              (std::uint32_t seed)) {
  Random random(seed);
  const CycleCase c = test::generic_case(random);
  CycleCase shifted = c;
  shifted.motion.u_mean += 3.0 * std::hypot(c.motion.u_sin, c.motion.u_cos);
  const FrictionCycle a = friction_cycle(c.point, c.motion);
  const FrictionCycle b = friction_cycle(shifted.point, shifted.motion);
  if (a.regime != CycleRegime::full_stick) {
    RC_ASSERT(a.friction.mean == b.friction.mean);
    RC_ASSERT(a.jacobian.col(0).isZero(0.0));
  }
}

// The force sampled in time, from the segments, has the coefficients that were returned. A rule of
// N points errs by O(N⁻²) for a force with kinks: 6 force scales cover the slopes.
TEST(FrictionCycle, ForceAtAPhaseHasTheFourierCoefficients) {
  Random random(8);
  constexpr int n_samples = 512;
  for (int i = 0; i < 1000; ++i) {
    const CycleCase c = test::generic_case(random);
    const FrictionCycle cycle = friction_cycle(c.point, c.motion);
    double sums[6] = {};
    for (int j = 0; j < n_samples; ++j) {
      const double phase = 2.0 * pi * j / n_samples;
      const CycleInstant now = at_phase(cycle, c.point, c.motion, phase);
      const double kernel[3] = {1.0, 2.0 * std::sin(phase), 2.0 * std::cos(phase)};
      for (int k = 0; k < 3; ++k) {
        sums[k] += kernel[k] * now.friction / n_samples;
        sums[3 + k] += kernel[k] * now.normal / n_samples;
      }
      ASSERT_LE(std::abs(now.friction),
                c.point.friction_coefficient * now.normal * (1.0 + rounding));
    }
    const double h = 2.0 * pi / n_samples;
    for (std::size_t k = 0; k < 6; ++k) {
      const double scale = k < 3 ? test::friction_scale(c) : test::normal_scale(c);
      ASSERT_NEAR(sums[k], coefficients(cycle)[k], 6.0 * h * h * scale) << i << ' ' << k;
    }
  }
}

TEST(FrictionCycle, ForceOfAPointThatHardlySticksIsExactToTheForceNotToItsSprings) {
  // Constant load, k_u a up to 1e10 μn: sticks 1e-5 of the cycle (theory section 5, case b = 0).
  // The springs alone would leave eps k_u a.
  const PointParameters point{1.0, 0.0, 0.5, 2.0};
  const double q = 1.0;
  for (const double amplitude : {1e2, 1e4, 1e6, 1e8, 1e10}) {
    const PointMotion motion{.u_sin = amplitude * std::cos(0.7),
                             .u_cos = amplitude * std::sin(0.7)};
    const long double a =
        std::hypot(static_cast<long double>(motion.u_sin), static_cast<long double>(motion.u_cos));
    const long double psi = 2.0L * std::atan2(std::sqrt(1.0L), std::sqrt(a - 1.0L));
    const long double half_turn = 3.14159265358979323846264338327950288L;
    const long double in_phase = a / half_turn * (psi - 0.5L * std::sin(2.0L * psi));
    const long double quadrature = 4.0L * (1.0L - 1.0L / a) / half_turn;
    const long double c = motion.u_sin / a;
    const long double s = motion.u_cos / a;
    const FrictionCycle force = friction_cycle(point, motion);
    // The reference itself cancels to eps (80 bits) times a ψ.
    EXPECT_NEAR(force.friction.sin, static_cast<double>(in_phase * c - quadrature * s), 5e-15 * q);
    EXPECT_NEAR(force.friction.cos, static_cast<double>(in_phase * s + quadrature * c), 5e-15 * q);
    EXPECT_NEAR(force.friction.mean, 0.0, 5e-15 * q);
  }
}

TEST(FrictionCycle, SliderRestsInStickAndFollowsInSeparation) {
  const PointParameters point{1.0, 1.0, 0.4, 0.3};
  const PointMotion motion{.u_mean = 0.2, .u_sin = 1.0, .v_sin = 0.3, .v_cos = 0.8};
  const FrictionCycle cycle = friction_cycle(point, motion);
  int stuck = 0;
  int open = 0;
  for (const CycleSegment& s : cycle.segments()) {
    const CycleInstant a = at_phase(cycle, point, motion, s.start + 0.25 * s.length);
    const CycleInstant b = at_phase(cycle, point, motion, s.start + 0.75 * s.length);
    if (s.state == ContactState::stick) {
      EXPECT_NEAR(a.slider, b.slider, rounding);
      ++stuck;
    } else if (s.state == ContactState::separated) {
      EXPECT_EQ(a.slider, a.u);
      ++open;
    }
  }
  EXPECT_GT(stuck, 0);
  EXPECT_GT(open, 0);
}

}  // namespace
}  // namespace microslip::contact::test_friction_cycle
