#include <gtest/gtest.h>

#include <memory>
#include <utility>

#include "contact/force/fewer_coordinates.hpp"
#include "contact/force/patch_force.hpp"

namespace microslip::contact::test_linear_proof {
namespace {

/// One mode on two points; u = x, v = x/2 on the second one.
PatchForce patch(const PointParameters& first, const PointParameters& second) {
  ModalShapes shapes{Eigen::MatrixXd(2, 1), Eigen::MatrixXd(2, 1), {}};
  shapes.u << 1.0, 1.0;
  shapes.v << 0.0, 0.5;
  return {ContactPatch(Eigen::Vector2d(1.0, 1.0), {first, second}), shapes};
}

std::unique_ptr<ModalForce> whole(const PointParameters& both) {
  ModalShapes shapes{Eigen::MatrixXd(2, 1), Eigen::MatrixXd(2, 1), {}};
  shapes.u << 1.0, 1.0;
  shapes.v << 0.0, 0.5;
  return std::make_unique<PatchForce>(ContactPatch(Eigen::Vector2d(1.0, 1.0), {both, both}),
                                      std::move(shapes));
}

Harmonics motion(double mean, double sine) {
  Harmonics q(1, 1);
  q.rows() << mean, sine, 0.0;
  return q;
}

constexpr PointParameters pressed{2.0, 1.0, 0.5, 10.0};
constexpr PointParameters gap{2.0, 1.0, 0.5, -1.0};

TEST(LinearState, OfASetShrinksToTheStateOfItsPoints) {
  PatchForce force = patch(pressed, pressed);
  // The second point moves in phase: no mean force while L₂ = k_u a + μ k_v b = 2.25 a ≤ μ n₀ = 5.
  EXPECT_EQ(force.linear_state(motion(0.0, 1.0), 0.5), LinearState::stuck);
  EXPECT_EQ(force.linear_state(motion(0.0, 2.22), 0.0), LinearState::stuck);
  EXPECT_EQ(force.linear_state(motion(0.0, 2.23), 0.0), LinearState::unknown);
  EXPECT_EQ(force.linear_state(motion(0.0, 1.0), 2.0), LinearState::unknown);
}

// Beside a motion of 1 that takes 2.25 of 5: another 2.25 of each 1.
TEST(LinearState, OfASpreadCountsWhatItMovesEveryPoint) {
  const auto state = [](double spread) {
    return patch(pressed, pressed)
        .linear_state_of({motion(0.0, 1.0), 0.0, Eigen::MatrixXd::Constant(1, 1, spread)});
  };
  EXPECT_EQ(state(1.2), LinearState::stuck);
  EXPECT_EQ(state(-1.2), LinearState::stuck);
  EXPECT_EQ(state(1.25), LinearState::unknown);
  // Columns add up, and so does a ball, √2 of its radius at the worst phase.
  const Eigen::MatrixXd two = Eigen::MatrixXd::Constant(1, 2, 0.6);
  EXPECT_EQ(patch(pressed, pressed).linear_state_of({motion(0.0, 1.0), 0.01, two}),
            LinearState::stuck);
  EXPECT_EQ(patch(pressed, pressed).linear_state_of({motion(0.0, 1.0), 0.03, two}),
            LinearState::unknown);
}

TEST(LinearState, OfASpreadIsSeenThroughCoordinates) {
  const auto state = [](double spread) {
    const FewerCoordinates force(Eigen::MatrixXd::Constant(1, 1, 2.0), whole(pressed));
    return force.linear_state_of({motion(0.0, 0.5), 0.0, Eigen::MatrixXd::Constant(1, 1, spread)});
  };
  EXPECT_EQ(state(0.6), LinearState::stuck);
  EXPECT_EQ(state(0.625), LinearState::unknown);
}

TEST(LinearState, NeedsTheMeanForceToBeThatOfTheSprings) {
  PatchForce force = patch(pressed, pressed);
  EXPECT_EQ(force.linear_state(motion(1.0, 1.0), 0.0), LinearState::stuck);
  EXPECT_EQ(force.linear_state(motion(2.0, 1.0), 0.0), LinearState::unknown);  // 2·2 + 2 > 5
}

TEST(LinearState, IsFreeOnlyBehindAGap) {
  EXPECT_EQ(patch(gap, gap).linear_state(motion(0.0, 1.0), 0.0), LinearState::free);
  EXPECT_EQ(patch(gap, gap).linear_state(motion(0.0, 1.0), 1.5), LinearState::unknown);
  const PointParameters frictionless{0.0, 0.0, 0.5, 10.0};
  // The first point exerts no dynamic force; the second opens at v < 1.
  EXPECT_EQ(patch(frictionless, gap).linear_state(motion(0.0, 1.9), 0.0), LinearState::free);
  EXPECT_EQ(patch(frictionless, gap).linear_state(motion(0.0, 2.1), 0.0), LinearState::unknown);
}

TEST(LinearState, OfAPreloadTakenAwayOrAGapClosedIsUnknown) {
  const PointParameters frictionless{0.0, 0.0, 0.5, 10.0};
  // Open for good, but by the mean motion: the preload is missed as a constant force.
  EXPECT_EQ(patch(frictionless, pressed).linear_state(motion(-40.0, 0.1), 0.0),
            LinearState::unknown);
  EXPECT_EQ(patch(frictionless, gap).linear_state(motion(1e3, 0.1), 0.0), LinearState::unknown);
}

TEST(LinearState, OfOnePointStuckAndOneOpenIsUnknown) {
  EXPECT_EQ(patch(pressed, gap).linear_state(motion(0.0, 0.1), 0.0), LinearState::unknown);
}

TEST(LinearState, RefusesOtherModes) {
  EXPECT_THROW(static_cast<void>(patch(pressed, gap).linear_state(Harmonics(1, 2), 0.0)),
               std::invalid_argument);
}

}  // namespace
}  // namespace microslip::contact::test_linear_proof
