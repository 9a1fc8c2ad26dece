#include "solver/time/time_guards.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "contact/transient/patch_transient.hpp"

namespace microslip::solver::test_time_guards {
namespace {

/// Mode 0 is u, mode 1 is v of a single point.
contact::PatchTransient one_point(const contact::PointParameters& point) {
  return {contact::ContactPatch(Eigen::VectorXd::Ones(1), {point}),
          contact::ModalShapes{Eigen::RowVector2d(1.0, 0.0), Eigen::RowVector2d(0.0, 1.0), {}}};
}

/// q = a t + ½ b t² from t = 0 over a length, b constant.
TimeSegment parabola(const Eigen::Vector2d& start, const Eigen::Vector2d& a,
                     const Eigen::Vector2d& b, double length) {
  return {0.0, length, {start, a}, length * a + 0.5 * length * length * b, length * b, b, b};
}

constexpr contact::GuardScale scale{1.0, 1.0};

TEST(FirstEvent, LiesWhereTheForceReachesTheCone) {
  const auto contact = one_point({5.0, 0.0, 0.5, 2.0});  // slips at u = 0.2
  const auto segment = parabola({0.0, 0.0}, {1.0, 0.0}, {0.0, 0.0}, 0.7);
  const auto event = first_event(contact, segment, contact.virgin_memory(), scale);
  ASSERT_TRUE(event.has_value());
  EXPECT_NEAR(0.7 * event->at, 0.2, 1e-12);
  EXPECT_EQ(event->points, std::vector<Eigen::Index>{0});
}

TEST(FirstEvent, IsNoneWhereTheStateHolds) {
  const auto contact = one_point({5.0, 0.0, 0.5, 2.0});
  const auto segment = parabola({0.0, 0.0}, {1.0, 0.0}, {0.0, 0.0}, 0.19);
  EXPECT_FALSE(first_event(contact, segment, contact.virgin_memory(), scale).has_value());
}

/// A point that leaves contact and is back between two samples of the guard.
TEST(FirstEvent, IsSeenInADipBetweenSamples) {
  const auto contact = one_point({5.0, 1.0, 0.5, 1.0});
  for (const double depth : {1e-2, 1e-4, 1e-6, 1e-8}) {
    for (const double bottom : {0.3, 0.37, 0.45, 0.62, 0.81}) {
      // n = 1 + v = −depth at t = bottom, curvature 20.
      const Eigen::Vector2d curve(0.0, 20.0);
      const Eigen::Vector2d start(0.0, -1.0 - depth + 10.0 * bottom * bottom);
      const Eigen::Vector2d slope(0.0, -20.0 * bottom);
      const auto event =
          first_event(contact, parabola(start, slope, curve, 1.0), contact.virgin_memory(), scale);
      ASSERT_TRUE(event.has_value()) << depth << " at " << bottom;
      // A root of a parabola this shallow: the tolerance moves it by its square root at most.
      EXPECT_NEAR(event->at, bottom - std::sqrt(depth / 10.0), 1e-6) << depth;
    }
  }
}

TEST(FirstEvent, IsTheEarliestOfSeveralPointsAndTakesThoseAtTheSameInstant) {
  const contact::PatchTransient contact(
      contact::ContactPatch(
          Eigen::VectorXd::Ones(4),
          {{5.0, 0.0, 0.5, 2.0}, {5.0, 0.0, 0.5, 1.0}, {5.0, 0.0, 0.5, 3.0}, {5.0, 0.0, 0.5, 1.0}}),
      {Eigen::MatrixXd::Ones(4, 1), Eigen::MatrixXd::Zero(4, 1), {}});
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(1);
  const Eigen::VectorXd one = Eigen::VectorXd::Ones(1);
  const TimeSegment segment(0.0, 1.0, {zero, one}, one, zero, zero, zero);
  const auto event = first_event(contact, segment, contact.virgin_memory(), scale);
  ASSERT_TRUE(event.has_value());
  EXPECT_NEAR(event->at, 0.1, 1e-12);
  EXPECT_EQ(event->points, (std::vector<Eigen::Index>{1, 3}));
}

}  // namespace
}  // namespace microslip::solver::test_time_guards
