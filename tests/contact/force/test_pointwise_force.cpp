/// What a patch tells must not depend on how its points are evaluated: located events, one point
/// after the other, beside the period sampled, all points in lanes.
#include "contact/force/pointwise_force.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <random>
#include <thread>
#include <vector>

#include "contact/force/patch_force.hpp"
#include "contact/force/point_method_force.hpp"
#include "contact/line/line_events.hpp"
#include "contact/sampled/patch_force.hpp"
#include "tests/support/asked_force.hpp"
#include "tests/support/floating_point_traps.hpp"

namespace microslip::contact::test_pointwise_force {
namespace {

// Lanes compute what they then do not take.
[[maybe_unused]] const tests::UntrappedFile this_file(__FILE__);

constexpr Eigen::Index n_points = 60;
constexpr Eigen::Index n_modes = 3;

/// Gaps and loads, points without friction, without a tangential and without a normal spring.
struct Points {
  explicit Points(unsigned seed) : random(seed) {
    std::uniform_real_distribution<double> u(-1.0, 1.0);
    for (int i = 0; i < n_points; ++i) {
      parameters.push_back({i % 13 == 0 ? 0.0 : 1.1 + u(random), i % 7 == 1 ? 0.0 : 1.1 + u(random),
                            i % 5 == 0 ? 0.0 : 0.5 + 0.4 * u(random), 6.0 * u(random) + 2.0});
    }
    const auto shape = [&] {
      return Eigen::MatrixXd::NullaryExpr(n_points, n_modes, [&] { return u(random); });
    };
    weights = Eigen::VectorXd::NullaryExpr(n_points, [&] { return 1.1 + u(random); });
    shapes = {shape(), shape(), {}};
  }

  [[nodiscard]] std::unique_ptr<PointwiseForce> by_events() const {
    std::vector<std::shared_ptr<const PointMethod>> methods;
    for (const PointParameters& point : parameters) {
      methods.push_back(std::make_shared<LineEvents>(point));
    }
    return std::make_unique<PointMethodForce>(weights, std::move(methods), shapes);
  }
  [[nodiscard]] std::unique_ptr<PointwiseForce> in_lanes() const {
    std::vector<SurfaceLaw> surfaces;
    for (const PointParameters& point : parameters) surfaces.emplace_back(point, 0.0);
    return std::make_unique<sampled::PatchForce>(weights, std::move(surfaces), shapes, 2048);
  }
  Harmonics motion(int n_harmonics, double size) {
    std::normal_distribution<double> g(0.0, size);
    Harmonics q(n_harmonics, n_modes);
    for (double& x : q.vector()) x = g(random);
    return q;
  }

  std::mt19937_64 random;
  std::vector<PointParameters> parameters;
  Eigen::VectorXd weights;
  ModalShapes shapes;
};

TEST(PointwiseForce, TellsTheSameByEventsAndInLanes) {
  Points points(3);
  const auto events = points.by_events();
  const auto lanes = points.in_lanes();
  EXPECT_LT((events->stuck_stiffness() - lanes->stuck_stiffness()).norm(),
            1e-14 * events->stuck_stiffness().norm());
  double most_slip = 0.0;
  for (const double size : {0.02, 0.1, 0.4, 1.5}) {
    const Harmonics q = points.motion(2, size);
    EXPECT_EQ(events->linear_state(q, 0.0), lanes->linear_state(q, 0.0));
    const CycleReport a = tests::report(*events, q, 1.0);
    const CycleReport b = tests::report(*lanes, q, 1.0);
    EXPECT_NEAR(a.stick_share, b.stick_share, 2e-3) << size;
    EXPECT_NEAR(a.slip_share, b.slip_share, 2e-3) << size;
    EXPECT_NEAR(a.separated_share, b.separated_share, 2e-3) << size;
    EXPECT_NEAR(a.slip_work, b.slip_work, 1e-4 * a.slip_work + 1e-12) << size;
    EXPECT_EQ(a.awake_share, b.awake_share) << size;
    most_slip = std::max(most_slip, a.slip_share);
    const ContactStates of_events = tests::states(*events, q, 1.0);
    const ContactStates of_lanes = tests::states(*lanes, q, 1.0);
    ASSERT_EQ(of_events.size(), of_lanes.size());
    EXPECT_LT(state_change(of_events, of_lanes).share, 0.02) << size;
  }
  EXPECT_GT(most_slip, 0.2);
}

// Forces without a tangential spring: by every method the face sticks, to nothing.
TEST(PointwiseForce, SticksWhereNoSpringCanSlip) {
  Points points(4);
  for (PointParameters& point : points.parameters) point.tangential_stiffness = 0.0;
  const Harmonics q = points.motion(2, 0.8);
  const CycleReport a = tests::report(*points.by_events(), q, 1.0);
  const CycleReport b = tests::report(*points.in_lanes(), q, 1.0);
  EXPECT_EQ(a.slip_share, 0.0);
  EXPECT_EQ(b.slip_share, 0.0);
  EXPECT_NEAR(a.stick_share, b.stick_share, 2e-3);
  EXPECT_GT(a.separated_share, 0.1);
}

TEST(PointwiseForce, StatesAreThoseOfTheMotionAskedFor) {
  Points points(5);
  for (const auto& force : {points.by_events(), points.in_lanes()}) {
    const Harmonics large = points.motion(2, 1.0);
    const Harmonics small = points.motion(2, 0.05);
    const ContactStates expected = tests::states(*force, small, 1.0);
    const auto work = force->workspace();
    (void)tests::evaluate(*force, large, 1.0, *work);
    (void)force->evaluate(small, 1.0, {.n_harmonics = 7}, *work);  // forces, perhaps no cycles
    ContactStates now;
    force->states(small, 1.0, now, *work);
    EXPECT_EQ(state_change(expected, now).share, 0.0);
    (void)force->report(large, 1.0, *work);
    force->states(small, 1.0, now, *work);
    EXPECT_EQ(state_change(expected, now).share, 0.0);
  }
}

TEST(PointwiseForce, NothingIsProvedOfAllMotionsThereAre) {
  Points points(6);
  const double all = std::numeric_limits<double>::infinity();
  for (const double size : {0.0, 0.02}) {
    const Harmonics q = points.motion(1, size);
    EXPECT_EQ(points.by_events()->linear_state(q, all), LinearState::unknown);
    EXPECT_EQ(points.in_lanes()->linear_state(q, all), LinearState::unknown);
    PatchForce closed(ContactPatch(points.weights, points.parameters), points.shapes);
    EXPECT_EQ(closed.linear_state(q, all), LinearState::unknown);
  }
}

// One force, asked by two threads at once, each in its own workspace.
TEST(PointwiseForce, AnswersThreadsThatShareItAsItAnswersOne) {
  Points points(8);
  std::vector<Harmonics> motions;
  for (int i = 0; i < 40; ++i) motions.push_back(points.motion(2, 0.02 * i));
  for (const auto& force : {points.by_events(), points.in_lanes()}) {
    const auto in_order = [&](const std::vector<Harmonics>& list) {
      std::vector<ForceAndJacobian> found;
      const auto work = force->workspace();
      for (const Harmonics& q : list) found.push_back(tests::evaluate(*force, q, 1.0, *work));
      return found;
    };
    const std::vector<ForceAndJacobian> alone = in_order(motions);
    std::vector<ForceAndJacobian> forwards;
    std::vector<ForceAndJacobian> backwards;
    {
      const std::jthread one([&] { forwards = in_order(motions); });
      const std::jthread other([&] { backwards = in_order({motions.rbegin(), motions.rend()}); });
    }
    for (std::size_t i = 0; i < alone.size(); ++i) {
      const ForceAndJacobian& last = backwards[alone.size() - 1 - i];
      EXPECT_EQ(forwards[i].force.vector(), alone[i].force.vector()) << i;
      EXPECT_EQ(forwards[i].jacobian, alone[i].jacobian) << i;
      EXPECT_EQ(last.force.vector(), alone[i].force.vector()) << i;
      EXPECT_EQ(last.jacobian, alone[i].jacobian) << i;
    }
  }
}

TEST(PointwiseForce, RefusesTheWorkspaceOfAnotherForce) {
  Points points(9);
  const auto force = points.in_lanes();
  const auto twin = points.in_lanes();
  const Harmonics q = points.motion(1, 0.1);
  ContactStates states;
  EXPECT_THROW((void)force->evaluate(q, 1.0, {}, *twin->workspace()), std::invalid_argument);
  EXPECT_THROW((void)force->report(q, 1.0, *twin->workspace()), std::invalid_argument);
  EXPECT_THROW(force->states(q, 1.0, states, *twin->workspace()), std::invalid_argument);
}

TEST(ModalForce, RefusesWhatItCannotAnswer) {
  Points points(7);
  const Harmonics q = points.motion(1, 0.1);
  const auto force = points.by_events();
  EXPECT_THROW((void)tests::evaluate(*force, q, 1.0, {.rows = {0, 1, 2}, .n_harmonics = 5}),
               std::invalid_argument);
  EXPECT_EQ(tests::evaluate(*force, q, 1.0, {.n_harmonics = 5}).force.n_harmonics(), 5);
  PatchForce closed(ContactPatch(points.weights, points.parameters), points.shapes);
  EXPECT_THROW((void)tests::evaluate(closed, q, 1.0, {.n_harmonics = 5}), std::invalid_argument);
  EXPECT_EQ(tests::evaluate(closed, q, 1.0, {}).jacobian.size(), 0);
  EXPECT_EQ(tests::evaluate(closed, q, 1.0, {.rows = {1, 2}}).jacobian.rows(), 2 * n_modes);
}

}  // namespace
}  // namespace microslip::contact::test_pointwise_force
