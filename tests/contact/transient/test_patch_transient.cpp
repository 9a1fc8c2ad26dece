#include "contact/transient/patch_transient.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include <gtest/gtest.h>

#include "contact/closed_form/friction_cycle.hpp"
#include "contact/force/patch_force.hpp"

namespace microslip::contact::test_patch_transient {
namespace {

constexpr double pi = std::numbers::pi;
constexpr GuardScale unit_scale{1.0, 1.0};

/// One point whose modal coordinates are u and v.
PatchTransient one_point(const PointParameters& point, double weight = 1.0) {
  return {ContactPatch(Eigen::VectorXd::Constant(1, weight), {point}),
          ModalShapes{Eigen::RowVector2d(1.0, 0.0), Eigen::RowVector2d(0.0, 1.0), {}}};
}

ModalMotion moving(double u, double v, double u_rate, double v_rate) {
  return {Eigen::Vector2d(u, v), Eigen::Vector2d(u_rate, v_rate)};
}

ModalMotion still(const Eigen::Vector2d& q) { return {q, Eigen::Vector2d::Zero()}; }

Eigen::Vector2d motion_at(const PointMotion& m, double phase) {
  return {m.u_mean + m.u_sin * std::sin(phase) + m.u_cos * std::cos(phase),
          m.v_mean + m.v_sin * std::sin(phase) + m.v_cos * std::cos(phase)};
}

TEST(PatchTransient, RefusesShapesOfAnotherSizeAndValuesThatAreNotFinite) {
  const ContactPatch patch(Eigen::VectorXd::Ones(2), std::vector<PointParameters>(2));
  const Eigen::MatrixXd good = Eigen::MatrixXd::Ones(2, 3);
  EXPECT_THROW(PatchTransient(patch, {Eigen::MatrixXd::Ones(3, 3), good, {}}),
               std::invalid_argument);
  EXPECT_THROW(PatchTransient(patch, {good, Eigen::MatrixXd::Ones(2, 2), {}}),
               std::invalid_argument);
  Eigen::MatrixXd bad = good;
  bad(1, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(PatchTransient(patch, {good, bad, {}}), std::invalid_argument);
}

TEST(PatchTransient, CarriesNoDynamicForceAtRest) {
  for (const double preload : {-2.0, 0.0, 3.0}) {
    const PatchTransient force = one_point({5.0, 7.0, 0.4, preload});
    const TransientMemory memory = force.virgin_memory();
    EXPECT_EQ(force.trial_force(still(Eigen::Vector2d::Zero()), memory), Eigen::Vector2d::Zero());
    EXPECT_EQ(force.held_force(still(Eigen::Vector2d::Zero()), memory), Eigen::Vector2d::Zero());
    EXPECT_EQ(memory.state[0], preload > 0.0 ? ContactState::stick : ContactState::separated);
  }
}

TEST(PatchTransient, TrialForceIsTheSpringUntilTheConeAndTheConeBeyond) {
  const PatchTransient force = one_point({5.0, 7.0, 0.5, 2.0}, 3.0);
  const TransientMemory memory = force.virgin_memory();
  EXPECT_DOUBLE_EQ(force.trial_force(still(Eigen::Vector2d(0.1, 0.0)), memory)[0], 3.0 * 0.5);
  EXPECT_DOUBLE_EQ(force.trial_force(still(Eigen::Vector2d(1.0, 0.0)), memory)[0], 3.0 * 1.0);
  EXPECT_DOUBLE_EQ(force.trial_force(still(Eigen::Vector2d(-1.0, 0.0)), memory)[0], -3.0 * 1.0);
  EXPECT_DOUBLE_EQ(force.trial_force(still(Eigen::Vector2d(0.0, 0.1)), memory)[1], 3.0 * 0.7);
  const Eigen::VectorXd open = force.trial_force(still(Eigen::Vector2d(1.0, -1.0)), memory);
  EXPECT_DOUBLE_EQ(open[0], 0.0);
  EXPECT_DOUBLE_EQ(open[1], -3.0 * 2.0);  // the preload is gone
}

TEST(PatchTransient, CommitMovesTheSliderByWhatItGivesWay) {
  const PatchTransient force = one_point({5.0, 0.0, 0.5, 2.0});
  TransientMemory memory = force.virgin_memory();
  const double work = force.commit(still(Eigen::Vector2d(1.0, 0.0)), memory);
  EXPECT_DOUBLE_EQ(memory.slider[0], 1.0 - 1.0 / 5.0);
  EXPECT_EQ(memory.state[0], ContactState::positive_slip);
  EXPECT_DOUBLE_EQ(work, 1.0 * 0.8);
  EXPECT_DOUBLE_EQ(force.commit(still(Eigen::Vector2d(0.9, 0.0)), memory), 0.0);
  EXPECT_EQ(memory.state[0], ContactState::stick);
}

TEST(PatchTransient, ManySmallCommitsTraceTheClosedFormCycle) {
  const PointParameters point{5.0, 3.0, 0.4, 1.0};
  const PointMotion motion{0.0, 0.8, 0.1, 0.05, 0.3, -0.6};
  const PatchTransient force = one_point(point);
  const FrictionCycle cycle = friction_cycle(point, motion);
  TransientMemory memory = force.virgin_memory();
  constexpr int n = 20000;
  double largest = 0.0;
  double work = 0.0;
  for (int i = 0; i < 2 * n; ++i) {
    const double phase = 2.0 * pi * i / n;
    const double step = force.commit(still(motion_at(motion, phase)), memory);
    if (i < n) continue;
    work += step;
    const CycleInstant now = at_phase(cycle, point, motion, phase);
    const Eigen::VectorXd G = force.trial_force(still(motion_at(motion, phase)), memory);
    largest = std::max(largest, std::abs(G[0] - now.friction));
    EXPECT_NEAR(G[1], now.normal - 1.0, 1e-12);
  }
  // Touch-down and the ends of slip are found to one step: k_u times its way.
  EXPECT_LT(largest, 5.0 * 1.0 * 2.0 * pi / n);
  EXPECT_NEAR(work, cycle.dissipated_energy, 1e-3 * cycle.dissipated_energy);
}

TEST(PatchTransient, HeldForceAgreesWithTheTrialForceWhereTheStateHolds) {
  const PatchTransient force = one_point({5.0, 3.0, 0.4, 1.0});
  for (const Eigen::Vector2d& q : {Eigen::Vector2d(0.05, 0.1), Eigen::Vector2d(0.9, 0.1),
                                   Eigen::Vector2d(-0.9, 0.1), Eigen::Vector2d(0.3, -0.9)}) {
    TransientMemory memory = force.virgin_memory();
    force.commit(still(q), memory);
    EXPECT_LT((force.held_force(still(q), memory) - force.trial_force(still(q), memory)).norm(),
              1e-15);
  }
}

TEST(PatchTransient, GuardsChangeSignWhereTheStateEnds) {
  const PatchTransient force = one_point({5.0, 3.0, 0.4, 1.0});
  TransientMemory memory = force.virgin_memory();
  // Stick ends at k_u u = μ n: u = 0.08.
  EXPECT_GT(force.guards_of(0, moving(0.08 - 1e-9, 0, 1, 0), memory, unit_scale)[0], 0.0);
  EXPECT_LT(force.guards_of(0, moving(0.08 + 1e-9, 0, 1, 0), memory, unit_scale)[0], 0.0);
  EXPECT_LT(force.guards_of(0, moving(-0.08 - 1e-9, 0, 1, 0), memory, unit_scale)[1], 0.0);
  memory.state[0] = ContactState::positive_slip;  // ends at k_u u̇ = μ k_v v̇
  EXPECT_GT(force.guards_of(0, moving(0.2, 0, 0.24 + 1e-9, 1), memory, unit_scale)[0], 0.0);
  EXPECT_LT(force.guards_of(0, moving(0.2, 0, 0.24 - 1e-9, 1), memory, unit_scale)[0], 0.0);
  memory.state[0] = ContactState::negative_slip;
  EXPECT_GT(force.guards_of(0, moving(0.2, 0, -0.24 - 1e-9, 1), memory, unit_scale)[0], 0.0);
  EXPECT_LT(force.guards_of(0, moving(0.2, 0, -0.24 + 1e-9, 1), memory, unit_scale)[0], 0.0);
  EXPECT_LT(force.guards_of(0, moving(0.2, -0.4, -1, -1), memory, unit_scale)[1], 0.0);
  memory.state[0] = ContactState::separated;
  EXPECT_GT(force.guards_of(0, moving(0, -0.4, 0, 1), memory, unit_scale)[0], 0.0);
  EXPECT_LT(force.guards_of(0, moving(0, -0.3, 0, 1), memory, unit_scale)[0], 0.0);
}

TEST(PatchTransient, GuardsOfAllPointsAreThoseOfEach) {
  Eigen::MatrixXd u(3, 2);
  Eigen::MatrixXd v(3, 2);
  u << 1.0, 0.3, -0.5, 0.7, 0.2, 0.9;
  v << 0.1, 0.8, 0.6, -0.4, 0.0, 0.5;
  const PatchTransient force(
      ContactPatch(Eigen::Vector3d(1.0, 2.0, 0.0),
                   {{5.0, 3.0, 0.4, 1.0}, {2.0, 1.0, 0.3, -0.1}, {1.0, 1.0, 0.3, 1.0}}),
      {u, v, {}});
  const ModalMotion motion = moving(0.2, -0.1, 0.7, 0.4);
  const TransientMemory memory = force.virgin_memory();
  const auto all = force.guards(motion, memory, unit_scale);
  for (Eigen::Index i = 0; i < 3; ++i) {
    const auto one = force.guards_of(i, motion, memory, unit_scale);
    EXPECT_NEAR(all(i, 0), one[0], 1e-15);
    EXPECT_NEAR(all(i, 1), one[1], 1e-15);
  }
  EXPECT_EQ(all(2, 0), 1.0);  // weight 0: never changes
}

/// Theory section 3: what follows separation is decided by the rates.
TEST(PatchTransient, ContactBeginsInTheStateOfTheRates) {
  const PatchTransient force = one_point({5.0, 3.0, 0.4, 0.0});
  const auto after = [&](double u_rate) {
    TransientMemory memory = force.virgin_memory();
    force.switch_state(0, moving(0.7, 1e-16, u_rate, 1.0), memory);
    EXPECT_EQ(memory.slider[0], 0.7);
    return memory.state[0];
  };
  EXPECT_EQ(after(0.23), ContactState::stick);
  EXPECT_EQ(after(0.25), ContactState::positive_slip);
  EXPECT_EQ(after(-0.25), ContactState::negative_slip);
}

TEST(PatchTransient, ForceIsContinuousWhereSlipTurnsIntoStick) {
  const PatchTransient force = one_point({5.0, 3.0, 0.4, 1.0});
  for (const ContactState slip : {ContactState::positive_slip, ContactState::negative_slip}) {
    TransientMemory memory = force.virgin_memory();
    memory.state[0] = slip;
    const ModalMotion motion = moving(0.6, 0.2, 0.0, 0.0);
    const Eigen::VectorXd before = force.held_force(motion, memory);
    force.switch_state(0, motion, memory);
    EXPECT_EQ(memory.state[0], ContactState::stick);
    EXPECT_LT((force.held_force(motion, memory) - before).norm(), 1e-15);
  }
}

TEST(PatchTransient, ContactEndsFromEveryState) {
  const PatchTransient force = one_point({5.0, 3.0, 0.4, 1.0});
  for (const ContactState state : {ContactState::stick, ContactState::positive_slip,
                                   ContactState::negative_slip, ContactState::slip}) {
    TransientMemory memory = force.virgin_memory();
    memory.state[0] = state;
    force.switch_state(0, moving(0.6, -0.4, 1.0, -1.0), memory);
    EXPECT_EQ(memory.state[0], ContactState::separated);
    EXPECT_EQ(memory.slider[0], 0.6);
  }
}

TEST(PatchTransient, WithoutFrictionOnlyTheLoadActs) {
  const PatchTransient force = one_point({5.0, 3.0, 0.0, 1.0});
  TransientMemory memory = force.virgin_memory();
  EXPECT_EQ(memory.state[0], ContactState::slip);
  EXPECT_EQ(force.held_force(still(Eigen::Vector2d(4.0, 0.1)), memory)[0], 0.0);
  EXPECT_EQ(force.trial_force(still(Eigen::Vector2d(4.0, 0.1)), memory)[0], 0.0);
  EXPECT_EQ(force.slip_power(moving(1, 0, 1, 0), memory), 0.0);
  EXPECT_EQ(force.stuck_stiffness()(0, 0), 0.0);
  EXPECT_EQ(force.stuck_stiffness()(1, 1), 3.0);
}

TEST(PatchTransient, SlipPowerIsFrictionTimesTheSpeedOfTheSlider) {
  const PatchTransient force = one_point({5.0, 3.0, 0.4, 1.0}, 2.0);
  TransientMemory memory = force.virgin_memory();
  memory.state[0] = ContactState::positive_slip;
  const double load = 1.0 + 3.0 * 0.1;
  const double slip_rate = 0.7 - 0.4 * 3.0 * 0.2 / 5.0;  // ds/dt = du/dt − (μ k_v/k_u) dv/dt
  EXPECT_NEAR(force.slip_power(moving(0.3, 0.1, 0.7, 0.2), memory), 2.0 * 0.4 * load * slip_rate,
              1e-15);
}

TEST(PatchTransient, SharesTheStuckLimitWithHarmonicBalance) {
  const ContactPatch patch(Eigen::Vector2d(0.5, 2.0), {{5.0, 3.0, 0.4, 1.0}, {2.0, 1.0, 0.0, 1.0}});
  const ModalShapes shapes{Eigen::MatrixXd::Random(2, 4), Eigen::MatrixXd::Random(2, 4), {}};
  const PatchTransient time(patch, shapes);
  EXPECT_LT((time.stuck_stiffness() - PatchForce(patch, shapes).stuck_stiffness()).norm(), 1e-14);
}

TEST(PatchTransient, SharesAreFractionsOfTheArea) {
  const PatchTransient force(ContactPatch(Eigen::Vector3d(1.0, 2.0, 5.0),
                                          std::vector<PointParameters>(3, {1.0, 1.0, 0.3, 1.0})),
                             {Eigen::MatrixXd::Ones(3, 1), Eigen::MatrixXd::Ones(3, 1), {}});
  TransientMemory memory = force.virgin_memory();
  memory.state = {ContactState::negative_slip, ContactState::separated, ContactState::stick};
  const StateShares shares = force.shares(memory);
  EXPECT_DOUBLE_EQ(shares.slip, 1.0 / 8.0);
  EXPECT_DOUBLE_EQ(shares.separated, 2.0 / 8.0);
  EXPECT_DOUBLE_EQ(shares.stick, 5.0 / 8.0);
}

}  // namespace
}  // namespace microslip::contact::test_patch_transient
