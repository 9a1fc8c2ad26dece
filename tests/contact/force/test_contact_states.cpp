// States of points over their period as numbers: what they say of a cycle, and what they say has
// changed.

#include <cmath>
#include <memory>
#include <numbers>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "contact/closed_form/cycle_states.hpp"
#include "contact/force/patch_force.hpp"
#include "contact/force/point_method_force.hpp"
#include "contact/line/line_events.hpp"
#include "contact/line/surface_line_events.hpp"
#include "contact/plane/planar_cycle.hpp"
#include "tests/support/asked_force.hpp"

namespace microslip::contact::test_contact_states {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;
constexpr double instant = 1.0 / PeriodStates::n_instants;

TEST(PeriodStates, CountTheInstantsThatDiffer) {
  const PeriodStates stuck;
  PeriodStates half = stuck;
  half.set(ContactState::positive_slip, 0.0, std::numbers::pi);
  EXPECT_DOUBLE_EQ(stuck.changed(half), 0.5);
  EXPECT_DOUBLE_EQ(half.changed(half), 0.0);
  PeriodStates wrapped = stuck;  // from 3/4 of the period to 1/4 of the next
  wrapped.set(ContactState::positive_slip, 0.75 * two_pi, 0.5 * two_pi);
  EXPECT_DOUBLE_EQ(wrapped.changed(half), 0.5);
  wrapped.set(ContactState::separated, -0.1, 2.0 * two_pi);
  EXPECT_DOUBLE_EQ(wrapped.changed(PeriodStates(ContactState::separated)), 0.0);
  EXPECT_DOUBLE_EQ(wrapped.changed(PeriodStates(ContactState::negative_slip)), 1.0);
}

TEST(PeriodStates, SlipWithoutForceCountsAsStick) {
  PeriodStates states(ContactState::negative_slip);
  states.set(ContactState::positive_slip, 1.0, 2.0);
  EXPECT_DOUBLE_EQ(states.without_slip().changed(PeriodStates()), 0.0);
  states.set(ContactState::separated, 0.0, std::numbers::pi);
  EXPECT_DOUBLE_EQ(states.without_slip().changed(PeriodStates()), 0.5);
}

struct Case {
  PointParameters point;
  PointMotion motion;
};

std::vector<Case> cases() {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  std::vector<Case> list;
  for (int i = 0; i < 200; ++i) {
    list.push_back({{1.0, i % 3 == 0 ? 0.0 : 1.0, 0.5, 1.5 * any(random)},
                    {0.0, any(random), any(random), 0.3 * any(random), any(random), any(random)}});
  }
  return list;
}

CycleStates states_of(const Case& c) {
  const SlipFunctions w = slip_functions(c.point, c.motion);
  const CycleRegime regime = cycle_regime(w);
  return cycle_states(regime, cycle_phases(w, regime));
}

TEST(CycleStates, AreThoseOfTheCycleAtTheirInstants) {
  for (const Case& c : cases()) {
    const FrictionCycle cycle = friction_cycle(c.point, c.motion);
    const CycleStates states = states_of(c);
    EXPECT_EQ(states.regime, cycle.regime);
    PeriodStates expected;
    for (int k = 0; k < PeriodStates::n_instants; ++k) {
      const double phase = two_pi * (k + 0.5) * instant;
      expected.set(at_phase(cycle, c.point, c.motion, phase).state, phase - 0.01, 0.02);
    }
    EXPECT_DOUBLE_EQ(states.period.changed(expected), 0.0);
  }
}

TEST(CycleStates, AreTheSameByEveryLaw) {
  for (const Case& c : cases()) {
    const CycleStates expected = states_of(c);
    Harmonics motion(1, n_point_signals);
    motion.rows().col(0) << c.motion.u_mean, c.motion.u_sin, c.motion.u_cos;
    motion.rows().col(1) << c.motion.v_mean, c.motion.v_sin, c.motion.v_cos;
    const SurfaceLaw surface(c.point, 0.0);
    PointTraction traction;
    LineEvents(c.point).traction(motion, 1.0, traction);
    EXPECT_DOUBLE_EQ(traction.period.changed(expected.period), 0.0);
    SurfaceLineEvents(surface).traction(motion, 1.0, traction);
    EXPECT_DOUBLE_EQ(traction.period.changed(expected.period), 0.0);
    PlaneEvents(surface).traction(motion, 1.0, traction);  // tells slip, not its direction
    EXPECT_LE(traction.period.without_slip().changed(expected.period.without_slip()), 0.0);
  }
}

ModalShapes shapes_of(std::size_t n_points) {
  const auto n = static_cast<Eigen::Index>(n_points);
  return {Eigen::MatrixXd::Ones(n, 1), Eigen::MatrixXd::Constant(n, 1, 0.5), {}};
}

TEST(ContactStates, OfAPatchAreTheSameByClosedFormAndByLaws) {
  std::vector<PointParameters> points;
  std::vector<std::shared_ptr<const PointMethod>> methods;
  for (const Case& c : cases()) {
    points.push_back(c.point);
    methods.push_back(std::make_shared<LineEvents>(c.point));
  }
  points[7].friction_coefficient = 0.0;
  methods[7] = std::make_shared<LineEvents>(points[7]);
  Eigen::VectorXd weights = Eigen::VectorXd::LinSpaced(200, 0.0, 2.0);  // the first has no area
  PatchForce closed(ContactPatch(weights, points), shapes_of(200));
  PointMethodForce by_methods(weights, methods, shapes_of(200));
  Harmonics q(1, 1);
  q.rows().col(0) << 0.1, 0.6, 0.7;
  const ContactStates a = tests::states(closed, q, 1.0);
  ContactStates b;
  const auto work = by_methods.workspace();
  by_methods.states(q, 1.0, b, *work);
  ASSERT_EQ(a.size(), 199U);
  ASSERT_EQ(b.size(), 199U);
  double area = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].cycle.regime, b[i].cycle.regime) << i;
    EXPECT_DOUBLE_EQ(a[i].share, b[i].share);
    area += a[i].share;
  }
  EXPECT_DOUBLE_EQ(state_change(a, b).share, 0.0);
  EXPECT_NEAR(area, 1.0, 1e-14);
  by_methods.states(q, 1.0, b, *work);  // what it keeps
  EXPECT_EQ(state_change(a, b).n_regimes, 0);
  EXPECT_DOUBLE_EQ(state_change(a, b).share, 0.0);
}

TEST(ContactStates, TellHowMuchHasChanged) {
  const ContactStates before{{0.25, {CycleRegime::full_stick, PeriodStates()}},
                             {0.75, {CycleRegime::full_stick, PeriodStates()}}};
  ContactStates after = before;
  after[0].cycle = {CycleRegime::separated, PeriodStates(ContactState::separated)};
  after[1].cycle.period.set(ContactState::positive_slip, 0.0, 0.5 * std::numbers::pi);
  const StateChange change = state_change(before, after);
  EXPECT_DOUBLE_EQ(change.share, 0.25 + 0.75 * 0.25);
  EXPECT_DOUBLE_EQ(change.largest, 1.0);
  EXPECT_EQ(change.n_regimes, 1);
  EXPECT_DOUBLE_EQ(state_change(before, {}).share, 0.0);
}

}  // namespace
}  // namespace microslip::contact::test_contact_states
