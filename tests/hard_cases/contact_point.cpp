/// What is hard: limits in which the printed formulas of a friction cycle divide by zero, pick a
/// wrong branch or lose all digits. Where: hard cases 1 to 12 of a contact point, theory sections
/// 4.5 and 19. Right: finite, continuous forces that agree with the event-locating reference.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "contact/closed_form/friction_cycle.hpp"
#include "contact/closed_form/slip_functions.hpp"
#include "support/cycle_cases.hpp"
#include "support/cycle_reference.hpp"

namespace microslip::test::contact_point {
namespace {

using contact::ContactState;
using contact::CycleRegime;
using contact::friction_cycle;
using contact::FrictionCycle;
using contact::PointMotion;
using contact::PointParameters;

constexpr double pi = std::numbers::pi;
// A dozen terms of the size of the force scale, each rounded at 1.1e-16.
constexpr double rounding = 2e-15;

std::vector<double> friction(const FrictionCycle& c) {
  return {c.friction.mean, c.friction.sin, c.friction.cos};
}

double distance(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    largest = std::max(largest, std::abs(a[i] - b[i]));
  }
  return largest;
}

void expect_finite(const FrictionCycle& c) {
  for (const double x : friction(c)) {
    EXPECT_TRUE(std::isfinite(x));
  }
  EXPECT_TRUE(std::isfinite(c.normal.mean) && std::isfinite(c.normal.sin));
  EXPECT_TRUE(std::isfinite(c.dissipated_energy) && std::isfinite(c.slip_distance));
  EXPECT_TRUE(c.jacobian.allFinite());
}

void expect_reference(const PointParameters& point, const PointMotion& motion) {
  const CycleCase c{point, motion};
  const FrictionCycle ours = friction_cycle(point, motion);
  const ReferenceCycle reference = reference_cycle(point, motion);
  const double f = rounding * friction_scale(c);
  const double n = rounding * normal_scale(c);
  EXPECT_NEAR(ours.friction.mean, static_cast<double>(reference.friction[0]), f);
  EXPECT_NEAR(ours.friction.sin, static_cast<double>(reference.friction[1]), f);
  EXPECT_NEAR(ours.friction.cos, static_cast<double>(reference.friction[2]), f);
  EXPECT_NEAR(ours.normal.mean, static_cast<double>(reference.normal[0]), n);
  EXPECT_NEAR(ours.normal.sin, static_cast<double>(reference.normal[1]), n);
  EXPECT_NEAR(ours.normal.cos, static_cast<double>(reference.normal[2]), n);
}

std::string sequence(const FrictionCycle& cycle) {
  std::string s;
  for (const contact::CycleSegment& segment : cycle.segments()) {
    s.push_back("SPNE"[static_cast<std::size_t>(segment.state)]);
  }
  return s;
}

// 1: a = 0, 1e-300 and subnormal.
TEST(ContactPointHard, VanishingTangentialMotionIsTheLimitOfSmallMotion) {
  for (const double preload : {-0.5, 0.0, 0.5, 1.0, 2.0}) {
    const PointParameters point{3.0, 1.0, 0.4, preload};
    const FrictionCycle still = friction_cycle(point, {.v_sin = 0.6, .v_cos = 0.8});
    expect_finite(still);
    EXPECT_EQ(distance(friction(still), {0.0, 0.0, 0.0}), 0.0);
    EXPECT_EQ(still.dissipated_energy, 0.0);
    for (const double a : {5e-324, 1e-310, 1e-300, 1e-30}) {
      const FrictionCycle c = friction_cycle(point, {.u_sin = a, .v_sin = 0.6, .v_cos = 0.8});
      expect_finite(c);
      EXPECT_LE(distance(friction(c), {0.0, 0.0, 0.0}), 3.0 * a + rounding * 1e-15);
      EXPECT_EQ(c.normal.mean, still.normal.mean);
    }
  }
  const FrictionCycle rest = friction_cycle({3.0, 1.0, 0.4, 1.0}, {});
  expect_finite(rest);
  EXPECT_EQ(rest.regime, CycleRegime::full_stick);
}

// 2: φ = 0, π exactly and ±1e-16: continuous across φ.
TEST(ContactPointHard, InPhaseMotionIsContinuousInThePhase) {
  for (const double direction : {1.0, -1.0}) {
    for (const double preload : {-0.8, -0.2, 0.0, 0.7, 1.0, 1.3, 2.5}) {
      for (const double b : {0.3, 1.0, 1.7}) {
        const PointParameters point{1.0, 1.0, 1.0, preload * b};
        const auto at = [&](double phase) {
          return PointMotion{
              .u_sin = 1.0, .v_sin = direction * b * std::cos(phase), .v_cos = b * std::sin(phase)};
        };
        const std::vector<double> exact = friction(friction_cycle(point, at(0.0)));
        for (const double phase : {1e-16, -1e-16, 1e-13, -1e-13}) {
          EXPECT_LE(distance(exact, friction(friction_cycle(point, at(phase)))),
                    8.0 * std::abs(phase) + rounding * (1.0 + 3.0 * b))
              << direction << ' ' << preload << ' ' << b << ' ' << phase;
        }
        expect_finite(friction_cycle(point, at(0.0)));
        expect_reference(point, at(0.0));
        expect_reference(point, at(1e-16));
      }
    }
  }
}

// 3: b* = 1 and φ = 0: L₁ = 0, positive slip and stick are the same force.
TEST(ContactPointHard, VanishingSlipFunctionHasAForce) {
  for (const double sign : {1.0, -1.0}) {
    for (const double preload : {-1.5, -0.5, 0.0, 0.5, 1.0, 1.5, 2.0, 3.0}) {
      const PointParameters point{4.0, 2.0, 0.5, preload};
      const PointMotion motion{.u_sin = 0.25, .v_sin = sign};
      const contact::SlipFunctions w = contact::slip_functions(point, motion);
      ASSERT_EQ(sign > 0.0 ? w.positive : w.negative, 0.0);
      expect_finite(friction_cycle(point, motion));
      expect_reference(point, motion);
    }
  }
}

// 4: grazing, n₀ = k_v b (1 ± 1e-15), and k_v b/2 < n₀ < k_v b, where the printed A-eq 20 is wrong.
TEST(ContactPointHard, GrazingContactIsContinuous) {
  const PointMotion motion{.u_sin = 1.3, .u_cos = -0.2, .v_sin = 0.6, .v_cos = 0.8};
  const double B = std::hypot(0.6, 0.8);
  for (const double side : {1.0, -1.0}) {
    const auto at = [&](double off) {
      return friction_cycle({1.0, 1.0, 0.5, side * B * (1.0 + off)}, motion);
    };
    for (const double off : {1e-15, -1e-15, 3e-16, -3e-16, 1e-10, -1e-10}) {
      expect_finite(at(off));
      EXPECT_LE(distance(friction(at(0.0)), friction(at(off))),
                4.0 * std::abs(off) + 2.0 * rounding);
      expect_reference({1.0, 1.0, 0.5, side * B * (1.0 + off)}, motion);
    }
  }
  for (const double share : {0.5, 0.51, 0.75, 0.99}) {
    const PointParameters point{1.0, 1.0, 0.5, share * B};
    EXPECT_EQ(friction_cycle(point, motion).regime, CycleRegime::separation);
    expect_reference(point, motion);
  }
}

// 5: onset of slip, 2q = L₁ + L₂: forces continuous, slip starting like the 3/2 power or linearly.
TEST(ContactPointHard, OnsetOfSlipIsContinuous) {
  for (const double b : {0.0, 0.4}) {
    const PointMotion motion{.u_sin = 1.0, .v_sin = 0.3 * b, .v_cos = b};
    const double mu = 0.5;
    const double L1 = std::hypot(1.0 - mu * 0.3 * b, mu * b);
    const double L2 = std::hypot(1.0 + mu * 0.3 * b, mu * b);
    const double limit = 0.5 * (L1 + L2) / mu;
    const auto at = [&](double off) {
      return friction_cycle({1.0, 1.0, mu, limit * (1.0 + off)}, motion);
    };
    for (const double off : {1e-16, -1e-16, 1e-14, -1e-14, 1e-9, -1e-9}) {
      expect_finite(at(off));
      EXPECT_LE(distance(friction(at(0.0)), friction(at(off))),
                4.0 * std::abs(off) + 2.0 * rounding);
    }
    EXPECT_EQ(at(1e-9).regime, CycleRegime::full_stick);
    EXPECT_EQ(at(-1e-9).regime, CycleRegime::stick_slip);
    // Dissipation grows from zero in proportion to the excess: 2 μ n times (L₁ + L₂ − 2q)/k_u.
    const double energy = at(-1e-9).dissipated_energy;
    EXPECT_GT(energy, 0.0);
    EXPECT_NEAR(at(-2e-9).dissipated_energy / energy, 2.0, 1e-4);  // next order: the root of 1e-9
  }
}

// 6: ties at touch-down, k_u u̇ = ± μ k_v v̇: a million of them; either choice has the same force.
TEST(ContactPointHard, TiesAtTouchDownAreDecidedConsistently) {
  Random random(31);
  const auto tie = std::ranges::find(strata(), "tie_at_touch_down", &Stratum::name);
  ASSERT_NE(tie, strata().end());
  for (int i = 0; i < 1000000; ++i) {
    const CycleCase c = tie->draw(random);
    const FrictionCycle a = friction_cycle(c.point, c.motion);
    CycleCase beside = c;
    beside.motion.u_sin *= 1.0 + 4e-16;
    beside.motion.u_cos *= 1.0 - 4e-16;
    const FrictionCycle b = friction_cycle(beside.point, beside.motion);
    ASSERT_LE(distance(friction(a), friction(b)), 3.0 * rounding * friction_scale(c)) << i;
  }
}

// 7: a very short contact: its length is 2γ ≈ 2 √(2 (1 + n₀/B)).
TEST(ContactPointHard, BarelyTouchingPointHasTheAsymptoticArc) {
  for (const double depth : {1e-6, 1e-9, 1e-12}) {
    const double n0 = -1.0 + depth;
    const FrictionCycle c = friction_cycle({1.0, 1.0, 0.5, n0}, {.u_sin = 1.0, .v_sin = 1.0});
    ASSERT_EQ(c.regime, CycleRegime::separation);
    double contact = 0.0;
    for (const contact::CycleSegment& segment : c.segments()) {
      contact += segment.state == ContactState::separated ? 0.0 : segment.length;
    }
    const double arc = 2.0 * std::sqrt(2.0 * (1.0 + n0));
    // Next term of the series: (1 + n₀)/12 relative; the contact is left over from 2π in rounding.
    EXPECT_NEAR(contact, arc, arc * depth + 4e-15);
  }
  expect_reference({1.0, 1.0, 0.5, 0.0}, {.u_sin = 1.0, .u_cos = 0.3, .v_sin = 1.0});
  expect_reference({1.0, 1.0, 0.5, -1.0 + 1e-12}, {.u_sin = 1.0, .u_cos = 0.3, .v_sin = 1.0});
}

// 8: never touching.
TEST(ContactPointHard, OpenPointHasExactlyNoForce) {
  const FrictionCycle c = friction_cycle({1.0, 1.0, 0.5, -1.0}, {.u_sin = 1.0, .v_sin = 1.0});
  EXPECT_EQ(c.regime, CycleRegime::separated);
  EXPECT_EQ(distance(friction(c), {0.0, 0.0, 0.0}), 0.0);
  EXPECT_EQ(c.normal.mean, 0.0);
  EXPECT_TRUE(c.jacobian.isZero(0.0));
  EXPECT_EQ(sequence(c), "E");
}

// 9: μ = 0: a one-sided spring, no friction and no work, whatever the motion.
TEST(ContactPointHard, FrictionlessPointDissipatesExactlyNothing) {
  Random random(33);
  const auto stratum = std::ranges::find(strata(), "frictionless", &Stratum::name);
  for (int i = 0; i < 10000; ++i) {
    const CycleCase c = stratum->draw(random);
    const FrictionCycle cycle = friction_cycle(c.point, c.motion);
    ASSERT_EQ(distance(friction(cycle), {0.0, 0.0, 0.0}), 0.0);
    ASSERT_EQ(cycle.dissipated_energy, 0.0);
    ASSERT_TRUE(cycle.jacobian.topRows(3).isZero(0.0));
    expect_finite(cycle);
  }
}

// 10: μ = 1e6: bonded while in contact, slider renewed at each touch-down.
TEST(ContactPointHard, StrongFrictionIsBondedContact) {
  const PointMotion motion{.u_sin = 1.0, .u_cos = 0.4, .v_sin = 0.3, .v_cos = 0.9};
  const PointParameters point{1.0, 1.0, 1e6, 0.2};
  const FrictionCycle c = friction_cycle(point, motion);
  expect_reference(point, motion);
  double slip = 0.0;
  for (const contact::CycleSegment& segment : c.segments()) {
    if (segment.state == ContactState::positive_slip ||
        segment.state == ContactState::negative_slip) {
      slip += segment.length;
    }
  }
  // The force left at lift-off must go to zero with the load: over a time of k_u u/(μ k_v v̇) =
  // 1e-6.
  EXPECT_LE(slip, 1e-5);
  EXPECT_EQ(friction_cycle({1.0, 1.0, 1e6, 2.0}, motion).regime, CycleRegime::full_stick);
}

// 11: wrap-around of angles: rotate one cycle through the whole circle.
TEST(ContactPointHard, SegmentsSumToThePeriodWhereverTheyWrap) {
  for (int i = 0; i < 1000; ++i) {
    const double t = 2.0 * pi * i / 1000.0;
    const PointMotion motion{.u_sin = 2.0 * std::cos(t),
                             .u_cos = 2.0 * std::sin(t),
                             .v_sin = std::cos(t + 1.0),
                             .v_cos = std::sin(t + 1.0)};
    const FrictionCycle c = friction_cycle({1.0, 1.0, 0.5, 0.3}, motion);
    double total = 0.0;
    for (std::size_t k = 0; k < c.segments().size(); ++k) {
      const contact::CycleSegment& now = c.segments()[k];
      const contact::CycleSegment& next = c.segments()[(k + 1) % c.segments().size()];
      const double gap = next.start - now.start - now.length;
      // One follows on the other, modulo 2π; a few roundings of angles.
      EXPECT_NEAR(gap - 2.0 * pi * std::round(gap / (2.0 * pi)), 0.0, 1e-14);
      total += now.length;
    }
    EXPECT_NEAR(total, 2.0 * pi, 1e-14);
  }
}

// 12: k_u = 0 has no friction, k_v = 0 a constant load.
TEST(ContactPointHard, MissingSpringsAreAllowed) {
  const PointMotion motion{.u_sin = 1.0, .v_sin = 1.0, .v_cos = 0.5};
  for (const double preload : {-2.0, 0.0, 0.5, 5.0}) {
    const FrictionCycle no_tangential = friction_cycle({0.0, 1.0, 0.5, preload}, motion);
    expect_finite(no_tangential);
    EXPECT_EQ(distance(friction(no_tangential), {0.0, 0.0, 0.0}), 0.0);
    EXPECT_EQ(no_tangential.slip_distance, 0.0);
    const FrictionCycle no_normal = friction_cycle({1.0, 0.0, 0.5, preload}, motion);
    expect_finite(no_normal);
    EXPECT_EQ(no_normal.normal.mean, std::max(preload, 0.0));
    EXPECT_EQ(no_normal.normal.sin, 0.0);
    expect_reference({1.0, 0.0, 0.5, preload}, motion);
    expect_finite(friction_cycle({0.0, 0.0, 0.5, preload}, motion));
  }
}

// 14: amplitudes from 1e-100 to 1e3 are the same cycle, powers of two.
TEST(ContactPointHard, AmplitudeIsOnlyAScale) {
  const PointParameters point{1e3, 2e3, 0.3, 0.4e3};
  const PointMotion motion{.u_sin = 1.0, .u_cos = 0.2, .v_mean = 0.05, .v_sin = -0.3, .v_cos = 0.9};
  const FrictionCycle whole = friction_cycle(point, motion);
  for (const int exponent : {-330, -200, -50, 10}) {
    const double s = std::exp2(exponent);
    PointParameters p = point;
    p.rest_load *= s;
    const FrictionCycle c = friction_cycle(
        p, {.u_sin = s, .u_cos = 0.2 * s, .v_mean = 0.05 * s, .v_sin = -0.3 * s, .v_cos = 0.9 * s});
    EXPECT_NEAR(c.friction.cos / s, whole.friction.cos, rounding * 2e3) << exponent;
    EXPECT_NEAR(c.normal.mean / s, whole.normal.mean, rounding * 2e3) << exponent;
    EXPECT_LE((c.jacobian - whole.jacobian).cwiseAbs().maxCoeff(), rounding * 1e4) << exponent;
  }
}

}  // namespace
}  // namespace microslip::test::contact_point
