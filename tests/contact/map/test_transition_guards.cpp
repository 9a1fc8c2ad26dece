#include "contact/closed_form/friction_cycle.hpp"
#include "contact/map/transition_guards.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <random>

#include "contact/contact_map.hpp"
#include "contact/line/line_events.hpp"
#include "contact/plane/planar_cycle.hpp"

namespace microslip::contact::test_transition_guards {
namespace {

PointMotion random_motion(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  PointMotion m;
  for (double* x : {&m.u_mean, &m.u_sin, &m.u_cos, &m.v_mean, &m.v_sin, &m.v_cos})
    *x = normal(random);
  m.v_mean *= 0.3;
  return m;
}

Harmonics harmonics_of(const PointMotion& m, int n_harmonics) {
  Harmonics motion(n_harmonics, n_point_signals);
  motion.rows().row(0) << m.u_mean, m.v_mean, 0.0;
  motion.rows().row(1) << m.u_sin, m.v_sin, 0.0;
  motion.rows().row(2) << m.u_cos, m.v_cos, 0.0;
  return motion;
}

// What the guards say about the period of a point.
void expect_regime(const TransitionGuards& guards, CycleRegime regime) {
  EXPECT_EQ(guards.largest_load <= 0.0, regime == CycleRegime::separated);
  if (regime == CycleRegime::separated) return;
  EXPECT_EQ(guards.smallest_load < 0.0, regime == CycleRegime::separation);
  EXPECT_EQ(guards.slip > 0.0, regime != CycleRegime::full_stick);
}

TEST(TransitionGuards, SignsAreTheRegimeOfTheClosedForm) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> load(-2.0, 6.0);
  std::array<int, 4> seen{};
  for (int i = 0; i < 2000; ++i) {
    const PointParameters point{1.0, 0.8, 0.5, load(random)};
    const PointMotion motion = random_motion(random);
    const CycleRegime regime = friction_cycle(point, motion).regime;
    ++seen[static_cast<std::size_t>(regime)];
    expect_regime(transition_guards(point, motion), regime);
  }
  for (const int n : seen) EXPECT_GT(n, 50);
}

TEST(TransitionGuards, SampledOnesAreTheClosedForm) {
  std::mt19937_64 random(2);
  for (int i = 0; i < 200; ++i) {
    const PointParameters point{1.3, 0.8, 0.5, 1.0};
    const PointMotion motion = random_motion(random);
    const TransitionGuards exact = transition_guards(point, motion);
    const SurfaceLaw law(point, 0.0);
    const TransitionGuards sampled = transition_guards(law, harmonics_of(motion, 3), 1.0, false);
    const double size = point.tangential_stiffness * std::hypot(motion.u_sin, motion.u_cos) +
                        2.0 * std::hypot(motion.v_sin, motion.v_cos) + 1.0;
    // A parabola through three of 256 samples of a sine errs by (π/128)⁴/384 of it; a crest between
    // samples by more.
    EXPECT_NEAR(sampled.slip, exact.slip, 1e-6 * size);
    EXPECT_NEAR(sampled.smallest_load, exact.smallest_load, 1e-6 * size);
    EXPECT_NEAR(sampled.largest_load, exact.largest_load, 1e-6 * size);
    SurfaceLaw second(point, 2.0);
    const TransitionGuards planar = transition_guards(second, harmonics_of(motion, 1), 1.0, true);
    // 64 samples miss a crest by (π/64)²/2 of it at most.
    EXPECT_NEAR(planar.slip, exact.slip, 3e-3 * size);
  }
}

TEST(TransitionGuards, SignsAreTheRegimeOfManyHarmonicsAndTwoDirections) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  int slipping = 0;
  for (int i = 0; i < 300; ++i) {
    const PointParameters point{1.0, 0.8, 0.5, 4.0 + normal(random)};
    Harmonics motion(3, n_point_signals);
    for (double& x : motion.vector()) x = 0.5 * normal(random);
    const Eigen::VectorXd phase = Eigen::VectorXd::Zero(1);
    const SurfaceLaw law(point, 1.5);
    const TransitionGuards one = transition_guards(law, motion, 1.0, false);
    const TransitionGuards two = transition_guards(law, motion, 1.0, true);
    if (std::abs(one.slip) > 1e-4) {  // else within the error of the samples
      expect_regime(one, LineEvents(point).history(motion, 1.0, phase, 1).regime);
      if (one.slip > 0.0) ++slipping;
    }
    if (std::abs(two.slip) > 0.05) {
      expect_regime(two, PlaneEvents(law, 1e-6).history(motion, 1.0, phase, 1).regime);
    }
    EXPECT_GE(two.slip, one.slip - 0.05);  // motion along r only adds to the force
  }
  EXPECT_GT(slipping, 50);
  EXPECT_LT(slipping, 250);
}

TEST(ContactMapOfManyHarmonics, KeepsEveryStartAndTheSharesOfThePeriod) {
  const PointParameters point{1.0, 0.0, 0.5, 1.0};
  const std::vector<std::shared_ptr<const PointMethod>> methods{
      std::make_shared<LineEvents>(point)};
  const ModalShapes shapes{Eigen::MatrixXd::Ones(1, 1), Eigen::MatrixXd::Zero(1, 1), {}};
  Harmonics q(3, 1);
  q.rows()(1, 0) = 0.1;
  q.rows()(5, 0) = 2.0;  // three times as fast: every state comes three times
  ContactMap map = contact_map(methods, shapes, q, 1.0, 8, 0.0);
  EXPECT_EQ(map.slip_guard.size(), 0);
  add_guards(map, {SurfaceLaw(point, 0.0)}, shapes, q, 1.0);
  EXPECT_GT(map.slip_guard[0], 0.0);
  EXPECT_NEAR(map.smallest_load[0], 1.0, 1e-15);
  const Eigen::Index m = map.state_starts.cols() / 5;
  ASSERT_EQ(m, 6);  // it sticks after every slip
  EXPECT_FALSE(std::isnan(map.state_starts(0, 5)));
  for (const Eigen::Index state : {1, 2}) {
    EXPECT_EQ(map.state_starts(0, state * m), map.state_start(0, state));
    EXPECT_LT(map.state_starts(0, state * m), map.state_starts(0, state * m + 1));
    EXPECT_LT(map.state_starts(0, state * m + 1), map.state_starts(0, state * m + 2));
    EXPECT_TRUE(std::isnan(map.state_starts(0, state * m + 3)));
  }
  EXPECT_NEAR(map.state_share.sum(), 1.0, 1e-14);
  EXPECT_NEAR(map.state_share(0, 1) + map.state_share(0, 2), map.slip_duration[0], 1e-14);
}

}  // namespace
}  // namespace microslip::contact::test_transition_guards
