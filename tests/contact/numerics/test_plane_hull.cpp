#include "contact/numerics/plane_hull.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace microslip::contact::test_plane_hull {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

Eigen::Matrix2Xd square() {
  Eigen::Matrix2Xd points(2, 6);
  points << -1, 1, 1, -1, 0, 0.3,  //
      -1, -1, 1, 1, -1, 0.2;
  return points;
}

TEST(PlaneHull, KeepsOnlyCorners) {
  EXPECT_EQ(PlaneHull(square()).corners().cols(), 4);
  EXPECT_NEAR(PlaneHull(square()).radius(), std::numbers::sqrt2, 2.0 * eps);
}

TEST(PlaneHull, MeasuresTheDistance) {
  const PlaneHull hull(square());
  EXPECT_NEAR(hull.signed_distance({0.7, 0.1}), -0.3, 2.0 * eps);
  EXPECT_EQ(hull.signed_distance({1.0, 0.5}), 0.0);
  EXPECT_NEAR(hull.signed_distance({1.5, 0.0}), 0.5, 2.0 * eps);
  EXPECT_NEAR(hull.signed_distance({2.0, 2.0}), std::numbers::sqrt2, 4.0 * eps);
}

TEST(PlaneHull, ReachesItsEdge) {
  const PlaneHull hull(square());
  EXPECT_NEAR(hull.reach({0.25, 0.1}), 4.0, 8.0 * eps);
  EXPECT_TRUE(std::isinf(hull.reach({0.0, 0.0})));
  EXPECT_TRUE(std::isnan(PlaneHull(square().array() + 2.0).reach({1.0, 0.0})));
}

TEST(PlaneHull, PointsOnALineAreASegment) {
  Eigen::Matrix2Xd points(2, 5);
  for (int i = 0; i < 5; ++i)
    points.col(i) = 0.1 * i * Eigen::Vector2d(std::cos(0.7), std::sin(0.7));
  const PlaneHull hull(points);
  EXPECT_EQ(hull.corners().cols(), 2);
  EXPECT_LT(hull.signed_distance(points.col(2)), -0.1);
  EXPECT_EQ(hull.signed_distance(points.col(4)), 0.0);
  EXPECT_NEAR(hull.signed_distance(1.5 * points.col(4)), 0.2, 4.0 * eps);
  EXPECT_TRUE(std::isnan(hull.reach({1.0, 0.0})));
}

TEST(PlaneHull, OnePointHoldsItself) {
  const Eigen::Matrix2Xd point = Eigen::Vector2d(0.3, -0.2);
  const PlaneHull hull(point);
  EXPECT_EQ(hull.corners().cols(), 1);
  EXPECT_LT(hull.signed_distance({0.3, -0.2}), 0.0);
  EXPECT_NEAR(hull.signed_distance({0.3, 0.8}), 1.0, 2.0 * eps);
  Eigen::Matrix2Xd twice(2, 2);
  twice << 0.3, 0.3, -0.2, -0.2;
  EXPECT_EQ(PlaneHull(twice).corners().cols(), 1);
}

}  // namespace
}  // namespace microslip::contact::test_plane_hull
