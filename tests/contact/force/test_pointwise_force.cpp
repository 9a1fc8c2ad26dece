/// What a patch tells must not depend on how its points are evaluated: located events, one point after the other,
/// beside the period sampled, all points in lanes.
#include "contact/force/pointwise_force.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <random>
#include <vector>

#include "contact/force/patch_force.hpp"
#include "contact/force/point_method_force.hpp"
#include "contact/line/line_events.hpp"
#include "contact/sampled/patch_force.hpp"
#include "tests/support/floating_point_traps.hpp"

namespace microslip::contact::test_pointwise_force {
namespace {

// Lanes compute what they then do not take.
[[maybe_unused]] const tests::UntrappedFile lanes(__FILE__);

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
    const CycleReport a = events->report(q, 1.0);
    const CycleReport b = lanes->report(q, 1.0);
    EXPECT_NEAR(a.stick_share, b.stick_share, 2e-3) << size;
    EXPECT_NEAR(a.slip_share, b.slip_share, 2e-3) << size;
    EXPECT_NEAR(a.separated_share, b.separated_share, 2e-3) << size;
    EXPECT_NEAR(a.slip_work, b.slip_work, 1e-4 * a.slip_work + 1e-12) << size;
    EXPECT_EQ(a.awake_share, b.awake_share) << size;
    most_slip = std::max(most_slip, a.slip_share);
    ContactStates of_events;
    ContactStates of_lanes;
    events->states(q, 1.0, of_events);
    lanes->states(q, 1.0, of_lanes);
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
  const CycleReport a = points.by_events()->report(q, 1.0);
  const CycleReport b = points.in_lanes()->report(q, 1.0);
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
    ContactStates expected;
    force->states(small, 1.0, expected);
    (void)force->evaluate(large, 1.0);
    (void)force->evaluate(small, 1.0, {.n_harmonics = 7});  // tells forces, perhaps no cycles
    ContactStates now;
    force->states(small, 1.0, now);
    EXPECT_EQ(state_change(expected, now).share, 0.0);
    (void)force->report(large, 1.0);
    force->states(small, 1.0, now);
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

TEST(ModalForce, RefusesWhatItCannotAnswer) {
  Points points(7);
  const Harmonics q = points.motion(1, 0.1);
  const auto force = points.by_events();
  EXPECT_THROW((void)force->evaluate(q, 1.0, {.rows = {0, 1, 2}, .n_harmonics = 5}),
               std::invalid_argument);
  EXPECT_EQ(force->evaluate(q, 1.0, {.n_harmonics = 5}).force.n_harmonics(), 5);
  PatchForce closed(ContactPatch(points.weights, points.parameters), points.shapes);
  EXPECT_THROW((void)closed.evaluate(q, 1.0, {.n_harmonics = 5}), std::invalid_argument);
  EXPECT_EQ(closed.evaluate(q, 1.0, {}).jacobian.size(), 0);
  EXPECT_EQ(closed.evaluate(q, 1.0, {.rows = {1, 2}}).jacobian.rows(), 2 * n_modes);
}

}  // namespace
}  // namespace microslip::contact::test_pointwise_force
