#include <gtest/gtest.h>

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
