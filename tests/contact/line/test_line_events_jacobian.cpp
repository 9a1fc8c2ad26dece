/// The Jacobian of the event law against differences of its forces: central where the sequence of
/// states stays the same, one-sided at the limit of full stick.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "contact/line/line_events.hpp"
#include "support/motion_cases.hpp"

namespace microslip::contact::test_line_events_jacobian {
namespace {

using test::MotionCase;
using Random = std::mt19937_64;

struct Outcome {
  Eigen::VectorXd force;
  std::string sequence;
  double shortest;
};

Outcome outcome(const MotionCase& c, Eigen::Index k, double step) {
  MotionCase moved = c;
  moved.motion.vector()[k] += step;
  const PointHistory history =
      LineEvents(c.point).history(moved.motion, 1.0, {}, c.motion.n_harmonics());
  Outcome result{history.force.vector(), {}, 7.0};
  for (const CycleSegment& segment : history.segments) {
    result.sequence.push_back("SPNE"[static_cast<std::size_t>(segment.state)]);
    result.shortest = std::min(result.shortest, segment.length);
  }
  return result;
}

double stiffness_scale(const MotionCase& c) {
  return c.point.tangential_stiffness +
         (1.0 + c.point.friction_coefficient) * c.point.normal_stiffness;
}

// A step of u or v that moves forces by 1e-4 of the least force that matters here.
double step_of(const MotionCase& c, Eigen::Index k) {
  const double force = test::friction_scale(c) / c.point.friction_coefficient;
  const double least = std::min(force, test::normal_scale(c));
  return 1e-5 * (k % 3 == 0 ? c.point.friction_coefficient * least / c.point.tangential_stiffness
                            : least / c.point.normal_stiffness);
}

// Central differences of fourth order, empty where a change of states is near.
Eigen::VectorXd central(const MotionCase& c, Eigen::Index k, double h) {
  const Outcome a = outcome(c, k, -2.0 * h);
  const Outcome b = outcome(c, k, -h);
  const Outcome d = outcome(c, k, h);
  const Outcome e = outcome(c, k, 2.0 * h);
  const std::string& s = a.sequence;
  if (s != b.sequence || s != d.sequence || s != e.sequence || a.shortest < 0.01 ||
      e.shortest < 0.01) {
    return {};
  }
  return (8.0 * (d.force - b.force) - (e.force - a.force)) / (12.0 * h);
}

// Second order from one side; `h` negative: from below.
Eigen::VectorXd one_sided(const MotionCase& c, Eigen::Index k, double h) {
  return (4.0 * outcome(c, k, h).force - 3.0 * outcome(c, k, 0.0).force -
          outcome(c, k, 2.0 * h).force) /
         (2.0 * h);
}

class LineEventsJacobian : public testing::TestWithParam<test::MotionStratum> {};

// Forces round at 1e-15 of their scale, so differences at 1e-10 of the stiffness; truncation is
// below that where differences at h and h/2 agree.
TEST_P(LineEventsJacobian, IsThatOfCentralDifferences) {
  Random random(20260205);
  int n_checked = 0;
  int n_drawn = 0;
  for (int i = 0; i < 150; ++i) {
    const MotionCase c = GetParam().draw(random);
    const double scale = stiffness_scale(c);
    PointTraction now;
    LineEvents(c.point).traction(c.motion, 1.0, now);
    for (Eigen::Index k = 0; k < now.jacobian.cols(); ++k) {
      if (k % 3 == 2) {
        ASSERT_TRUE((now.jacobian.col(k).array() == 0.0).all());
        continue;
      }
      ++n_drawn;
      const double h = step_of(c, k);
      const Eigen::VectorXd coarse = central(c, k, h);
      const Eigen::VectorXd fine = central(c, k, 0.5 * h);
      if (coarse.size() == 0 || fine.size() == 0) continue;
      const double doubt = (coarse - fine).cwiseAbs().maxCoeff();
      if (doubt > 1e-8 * scale) continue;
      // Where extrema tie, as they do when harmonics are missing, the law gives the derivative of
      // the first of them, and every direction has its own.
      if ((one_sided(c, k, h) - one_sided(c, k, -h)).cwiseAbs().maxCoeff() > 1e-3 * scale) continue;
      ++n_checked;
      ASSERT_LE((now.jacobian.col(k) - fine).cwiseAbs().maxCoeff(), 1e-7 * scale)
          << i << " column " << k;
    }
  }
  EXPECT_GT(n_checked, n_drawn / 4);
}

std::vector<test::MotionStratum> smooth_strata() {
  std::vector<test::MotionStratum> chosen;
  for (const test::MotionStratum& stratum : test::motion_strata()) {
    for (const char* name :
         {"generic", "comparable", "loaded", "gap", "zero_harmonics", "repeated"}) {
      if (stratum.name == name) chosen.push_back(stratum);
    }
  }
  return chosen;
}

INSTANTIATE_TEST_SUITE_P(Strata, LineEventsJacobian, testing::ValuesIn(smooth_strata()),
                         [](const auto& instance) { return std::string(instance.param.name); });

// Full stick with the mean pushed against an end of the admissible band: the derivative is that of
// the end; with the mean inside, it is k_u for the mean alone.
TEST(LineEventsJacobianOfFullStick, FollowsTheActiveEndOfTheBand) {
  Harmonics motion(2, 3);
  motion.rows().col(0) << 0.0, 1.0, 0.2, 0.3, -0.1;
  motion.rows().col(1) << 0.0, 0.1, 0.4, 0.2, 0.0;
  const PointParameters point{1.0, 0.8, 0.5, 6.0};
  for (const double mean : {0.3, 50.0, -50.0}) {
    motion.rows()(0, 0) = mean;
    const MotionCase c{point, motion};
    PointTraction now;
    LineEvents(point).traction(motion, 1.0, now);
    ASSERT_EQ(now.regime, CycleRegime::full_stick);
    EXPECT_EQ(now.jacobian(0, 0), mean == 0.3 ? 1.0 : 0.0);
    for (Eigen::Index k = 0; k < now.jacobian.cols(); ++k) {
      if (k % 3 == 2) continue;
      // The step 1e-4 squared times the curvature of the extremum, about 1.
      EXPECT_LE((now.jacobian.col(k) - central(c, k, 1e-4)).cwiseAbs().maxCoeff(), 1e-8) << k;
    }
  }
}

// At the onset of slip the derivative from the stuck side is that of full stick.
TEST(LineEventsJacobianOfFullStick, IsOneSidedAtTheOnsetOfSlip) {
  Harmonics motion(2, 3);
  motion.rows().col(0) << 0.0, 1.0, 0.0, 0.0, 0.0;
  const PointParameters point{1.0, 0.0, 0.5, 2.0};  // μ n₀ = k_u a: just full stick
  PointTraction now;
  LineEvents(point).traction(motion, 1.0, now);
  EXPECT_EQ(now.regime, CycleRegime::full_stick);
  PointTraction less;
  motion.rows()(1, 0) -= 1e-6;
  LineEvents(point).traction(motion, 1.0, less);
  EXPECT_NEAR((now.force.rows()(1, 0) - less.force.rows()(1, 0)) / 1e-6, now.jacobian(3, 3), 1e-9);
}

}  // namespace
}  // namespace microslip::contact::test_line_events_jacobian
