/// Relations every exact cycle of one tangential direction obeys,
/// over random motions of all strata.
#include "contact/line/line_events.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "support/cycle_cases.hpp"
#include "support/motion_cases.hpp"

namespace microslip::contact::test_line_events {
namespace {

using test::friction_scale;
using test::MotionCase;
using test::MotionStratum;
using test::normal_scale;
using Random = std::mt19937_64;

constexpr double pi = std::numbers::pi;
// Some tens of terms of the force scale, each rounded at 1.1e-16, phases up to 4π at 4e-16.
constexpr double rounding = 2e-14;
constexpr double smallest = 1e-318;  // spacing of subnormal numbers, with room

PointTraction traction(const MotionCase& c) {
  PointTraction result;
  LineEvents(c.point).traction(c.motion, 1.0, result);
  return result;
}

double difference(const Harmonics& a, const Harmonics& b, int signal) {
  return (a.rows().col(signal) - b.rows().col(signal)).cwiseAbs().maxCoeff();
}

Harmonics shifted(const Harmonics& y, double angle) {
  Harmonics result = y;
  for (int h = 1; h <= y.n_harmonics(); ++h) {
    const double s = std::sin(h * angle);
    const double c = std::cos(h * angle);
    for (Eigen::Index k = 0; k < y.n_signals(); ++k) {
      const double sin = y.rows()(2 * h - 1, k);
      const double cos = y.rows()(2 * h, k);
      result.rows()(2 * h - 1, k) = sin * c - cos * s;
      result.rows()(2 * h, k) = sin * s + cos * c;
    }
  }
  return result;
}

class LineEventsProperties : public testing::TestWithParam<MotionStratum> {
 protected:
  template <typename Check>
  static void for_all(int n_cases, const Check& check) {
    Random random(20260202);
    for (int i = 0; i < n_cases && !HasFatalFailure(); ++i) {
      SCOPED_TRACE(i);
      check(GetParam().draw(random));
    }
  }
};

TEST_P(LineEventsProperties, EverythingIsFinite) {
  for_all(600, [](const MotionCase& c) {
    const PointTraction now = traction(c);
    ASSERT_TRUE(now.force.rows().allFinite());
    ASSERT_TRUE(now.jacobian.allFinite());
    ASSERT_EQ(now.jacobian.rows(), now.force.vector().size());
    ASSERT_TRUE((now.frequency_derivative.array() == 0.0).all());
    ASSERT_TRUE((now.force.rows().col(2).array() == 0.0).all());
  });
}

TEST_P(LineEventsProperties, StatesAreThoseOfTheForce) {
  for_all(300, [](const MotionCase& c) {
    const PointTraction now = traction(c);
    PointTraction told;
    LineEvents(c.point).states(c.motion, 1.0, told);
    ASSERT_EQ(told.regime, now.regime);
    ASSERT_EQ(told.period.changed(now.period), 0.0);
  });
}

TEST_P(LineEventsProperties, TractionAndHistoryGiveTheSameForce) {
  for_all(300, [](const MotionCase& c) {
    const PointTraction now = traction(c);
    const PointHistory history =
        LineEvents(c.point).history(c.motion, 1.0, {}, c.motion.n_harmonics());
    ASSERT_EQ(now.force.rows(), history.force.rows());
    ASSERT_EQ(now.regime, history.regime);
  });
}

// Theory section 7: both are exact for each point.
TEST_P(LineEventsProperties, FrictionWorkIsSlipWorkAndNormalWorkIsNone) {
  for_all(1000, [](const MotionCase& c) {
    const int H = c.motion.n_harmonics();
    const PointHistory history = LineEvents(c.point).history(c.motion, 1.0, {}, H);
    // What slips is of the size of u, or of the deflection of the spring.
    const double k_u = c.point.tangential_stiffness;
    const double u = k_u > 0.0 ? friction_scale(c) / k_u : 0.0;
    const double v = c.motion.rows().col(1).tail(2 * H).cwiseAbs().sum();
    ASSERT_LE(std::abs(test::cycle_work(c.motion, history.force, 0) - history.dissipated_energy),
              10.0 * rounding * H * friction_scale(c) * u + smallest);
    ASSERT_LE(std::abs(test::cycle_work(c.motion, history.force, 1)),
              10.0 * rounding * H * normal_scale(c) * v + smallest);
    ASSERT_GE(history.dissipated_energy, 0.0);
    ASSERT_EQ(history.dissipated_energy, c.point.friction_coefficient * history.normal_slip);
  });
}

TEST_P(LineEventsProperties, AShiftInPhaseShiftsTheForces) {
  for_all(500, [](const MotionCase& c) {
    MotionCase moved = c;
    moved.motion = shifted(c.motion, 1.234);
    const Harmonics expected = shifted(traction(c).force, 1.234);
    const Harmonics force = traction(moved).force;
    // The coefficients of the shifted motion are rounded anew: 1e-16 of each.
    ASSERT_LE(difference(force, expected, 0), 2.0 * rounding * friction_scale(c) + smallest);
    ASSERT_LE(difference(force, expected, 1), 2.0 * rounding * normal_scale(c) + smallest);
  });
}

TEST_P(LineEventsProperties, ReversalOfUReversesFriction) {
  for_all(500, [](const MotionCase& c) {
    MotionCase reversed = c;
    reversed.motion.rows().col(0) *= -1.0;
    Harmonics expected = traction(c).force;
    expected.rows().col(0) *= -1.0;
    const Harmonics force = traction(reversed).force;
    ASSERT_LE(difference(force, expected, 0), rounding * friction_scale(c) + smallest);
    ASSERT_LE(difference(force, expected, 1), rounding * normal_scale(c) + smallest);
  });
}

// Where nothing underflows, a power of two changes no bit.
TEST_P(LineEventsProperties, PowersOfTwoScaleForcesBitByBit) {
  if (GetParam().name == "tiny_and_large") return;
  for_all(500, [](const MotionCase& c) {
    for (const double factor : {0x1p-70, 0x1p63}) {
      MotionCase scaled = c;
      scaled.motion.rows() *= factor;
      scaled.point.rest_load *= factor;
      const PointTraction plain = traction(c);
      const PointTraction other = traction(scaled);
      ASSERT_EQ(other.force.rows(), (factor * plain.force.rows()).eval());
      ASSERT_EQ(other.jacobian, plain.jacobian);
    }
  });
}

TEST_P(LineEventsProperties, SegmentsCoverThePeriodInOrder) {
  for_all(500, [](const MotionCase& c) {
    const PointHistory history = LineEvents(c.point).history(c.motion, 1.0, {}, 1);
    ASSERT_FALSE(history.segments.empty());
    double total = 0.0;
    double before = -1.0;
    for (const CycleSegment& segment : history.segments) {
      ASSERT_GT(segment.start, before);
      ASSERT_LT(segment.start, 2.0 * pi);
      ASSERT_GT(segment.length, 0.0);
      total += segment.length;
      before = segment.start;
    }
    // Roundings of numbers up to 4π, one per phase; phases shorter than 4e-15 may have been
    // dropped.
    ASSERT_NEAR(total, 2.0 * pi, 1e-13);
  });
}

TEST_P(LineEventsProperties, InstantsObeyTheLaw) {
  const Eigen::VectorXd phases = Eigen::VectorXd::LinSpaced(60, -3.0, 9.0);
  for_all(300, [&](const MotionCase& c) {
    const PointHistory history = LineEvents(c.point).history(c.motion, 1.0, phases, 1);
    ASSERT_EQ(history.instants.size(), 60U);
    for (const PointInstant& now : history.instants) {
      const double limit = c.point.friction_coefficient * now.traction[1];
      ASSERT_LE(std::abs(now.traction[0]), limit);
      ASSERT_GE(now.traction[1], 0.0);
      const double load = c.point.rest_load + c.point.normal_stiffness * now.motion[1];
      if (now.state != ContactState::separated) {
        ASSERT_EQ(now.traction[1], std::max(load, 0.0));
      } else {
        ASSERT_LE(load, 2.0 * rounding * normal_scale(c) + smallest);
      }
      if (now.state == ContactState::positive_slip) {
        ASSERT_EQ(now.traction[0], limit);
      } else if (now.state == ContactState::negative_slip) {
        ASSERT_EQ(now.traction[0], -limit);
      }
    }
  });
}

INSTANTIATE_TEST_SUITE_P(Strata, LineEventsProperties, testing::ValuesIn(test::motion_strata()),
                         [](const auto& instance) { return std::string(instance.param.name); });

TEST(LineEvents, DoesNotSeeTheSecondDirection) {
  Random random(1);
  for (int i = 0; i < 200; ++i) {
    MotionCase c = test::generic_motion(random);
    const PointTraction plain = traction(c);
    c.motion.rows().col(2).setConstant(std::numeric_limits<double>::quiet_NaN());
    const PointTraction other = traction(c);
    ASSERT_EQ(other.force.rows(), plain.force.rows());
    ASSERT_EQ(other.jacobian, plain.jacobian);
  }
}

TEST(LineEvents, AResultIsWrittenWholeWhateverItHeld) {
  Random random(2);
  PointTraction used;
  for (int i = 0; i < 300; ++i) {
    const MotionCase c = test::generic_motion(random);
    LineEvents(c.point).traction(c.motion, 1.0, used);
    const PointTraction fresh = traction(c);
    ASSERT_EQ(used.force.rows(), fresh.force.rows());
    ASSERT_EQ(used.jacobian, fresh.jacobian);
    used.jacobian.setConstant(7.0);
    used.frequency_derivative.setConstant(7.0);
    used.force.rows().setConstant(7.0);
  }
}

// Forces up to the largest doubles, as for one of size 1.
TEST(LineEvents, HugeForcesDoNotOverflowBetween) {
  Random random(3);
  for (int i = 0; i < 200; ++i) {
    MotionCase c = test::motion_strata()[1].draw(random);
    const PointTraction plain = traction(c);
    c.point.rest_load *= 0x1p990;
    c.motion.rows() *= 0x1p990;
    const PointTraction huge = traction(c);
    ASSERT_EQ(huge.force.rows(), (0x1p990 * plain.force.rows()).eval());
    ASSERT_EQ(huge.jacobian, plain.jacobian);
  }
}

// A load that only touches zero never separates, as in the closed form.
TEST(LineEvents, GrazingAtPhaseZeroIsNotSeparation) {
  const PointParameters point{1.0, 1.0, 0.5, 1.0};
  Harmonics motion(1, 3);
  motion.rows().col(0) << 0.0, 3.0, 0.4;
  motion.rows().col(1) << 0.0, 0.0, -1.0;
  const FrictionCycle closed = friction_cycle(point, {0.0, 3.0, 0.4, 0.0, 0.0, -1.0});
  const PointHistory history = LineEvents(point).history(motion, 1.0, {}, 1);
  EXPECT_EQ(history.regime, closed.regime);
  EXPECT_NEAR(history.force.rows()(1, 0), closed.friction.sin, rounding);
}

TEST(LineEvents, StiffnessAndLoadAtRest) {
  const LineEvents method({3.0, 2.0, 0.5, 7.0});
  EXPECT_EQ(method.stuck_stiffness(), Eigen::Vector3d(3.0, 2.0, 0.0));
  EXPECT_EQ(method.reference_load(), 7.0);
  const LineEvents frictionless_gap({3.0, 2.0, 0.0, -7.0});
  EXPECT_EQ(frictionless_gap.stuck_stiffness(), Eigen::Vector3d(0.0, 2.0, 0.0));
  EXPECT_EQ(frictionless_gap.reference_load(), 0.0);
}

// ---- one harmonic: the closed form

Harmonics as_harmonics(const PointMotion& m) {
  Harmonics motion(1, 3);
  motion.rows() << m.u_mean, m.v_mean, 0.0, m.u_sin, m.v_sin, 0.0, m.u_cos, m.v_cos, 0.0;
  return motion;
}

class LineEventsWithOneHarmonic : public testing::TestWithParam<test::Stratum> {};

TEST_P(LineEventsWithOneHarmonic, IsTheClosedForm) {
  Random random(20260203);
  for (int i = 0; i < 2000; ++i) {
    const test::CycleCase c = GetParam().draw(random);
    const FrictionCycle closed = friction_cycle(c.point, c.motion);
    const PointHistory history = LineEvents(c.point).history(as_harmonics(c.motion), 1.0, {}, 1);
    const auto& force = history.force.rows();
    const double f = rounding * test::friction_scale(c) + smallest;
    const double n = rounding * test::normal_scale(c) + smallest;
    ASSERT_NEAR(force(0, 0), closed.friction.mean, f) << i;
    ASSERT_NEAR(force(1, 0), closed.friction.sin, f) << i;
    ASSERT_NEAR(force(2, 0), closed.friction.cos, f) << i;
    ASSERT_NEAR(force(0, 1), closed.normal.mean, n) << i;
    ASSERT_NEAR(force(1, 1), closed.normal.sin, n) << i;
    ASSERT_NEAR(force(2, 1), closed.normal.cos, n) << i;
    const double slip = c.point.tangential_stiffness > 0.0
                            ? test::friction_scale(c) / c.point.tangential_stiffness
                            : 0.0;
    ASSERT_NEAR(history.dissipated_energy, closed.dissipated_energy, 20.0 * f * slip + smallest);
  }
}

INSTANTIATE_TEST_SUITE_P(Strata, LineEventsWithOneHarmonic, testing::ValuesIn(test::strata()),
                         [](const auto& instance) { return std::string(instance.param.name); });

// Entries of the event Jacobian in the order of CycleJacobian.
CycleJacobian single(const Eigen::MatrixXd& jacobian) {
  constexpr Eigen::Index order[] = {0, 3, 6, 1, 4, 7};
  CycleJacobian J;
  for (Eigen::Index i = 0; i < 6; ++i) {
    for (Eigen::Index j = 0; j < 6; ++j) J(i, j) = jacobian(order[i], order[j]);
  }
  return J;
}

TEST(LineEventsWithOneHarmonicJacobian, IsTheClosedFormAwayFromLimits) {
  Random random(20260204);
  int n_checked = 0;
  for (int i = 0; i < 20000; ++i) {
    const test::CycleCase c = test::generic_case(random);
    const FrictionCycle closed = friction_cycle(c.point, c.motion);
    double shortest = 2.0 * pi;
    for (const CycleSegment& segment : closed.segments()) {
      shortest = std::min(shortest, segment.length);
    }
    const PointTraction now = traction({c.point, as_harmonics(c.motion)});
    ASSERT_EQ(now.regime, closed.regime);
    if (shortest < 0.02) continue;  // near a limit
    const double scale = c.point.tangential_stiffness +
                         (1.0 + c.point.friction_coefficient) * c.point.normal_stiffness;
    ASSERT_LE((single(now.jacobian) - closed.jacobian).cwiseAbs().maxCoeff(), 1e-12 * scale) << i;
    ++n_checked;
  }
  EXPECT_GT(n_checked, 10000);
}

}  // namespace
}  // namespace microslip::contact::test_line_events
