#include "pipelines/accuracy/points_to_check.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <gtest/gtest.h>

namespace microslip::pipelines::test_points_to_check {
namespace {

using Indices = std::vector<std::size_t>;
constexpr double threshold = 0.1;

/// A resonance with its peak in the middle, and slopes everywhere.
solver::ResponseCurve resonance(std::size_t n) {
  solver::ResponseCurve curve;
  const std::size_t middle = n / 2;
  for (std::size_t i = 0; i < n; ++i) {
    solver::ResponsePoint& point = curve.points.emplace_back();
    point.amplitude = 1.0 / (1.0 + std::abs(static_cast<double>(i) - static_cast<double>(middle)));
    point.slope = solver::BranchSlope{};
  }
  curve.points[middle].mark = solver::PointMark::peak;
  return curve;
}

// Where the output hardly moves the indicator is largest; then come what is left out beside the
// peak, and places far from all of these.
TEST(PointsToCheck, AreTheLargestIndicatorAndWhereMuchIsLeftOutFarFromOthers) {
  const solver::ResponseCurve curve = resonance(41);
  Eigen::VectorXd indicator = Eigen::VectorXd::Constant(41, 0.2);
  indicator[0] = 1.0;   // of an amplitude of 1/21
  indicator[24] = 0.6;  // of 1/5
  const Indices found = points_to_check(curve, indicator, threshold);
  ASSERT_EQ(found.size(), 6U);
  EXPECT_EQ(found[0], 0U);
  EXPECT_EQ(found[1], 24U);  // 4 × 0.6/5; at most 0.2 × 10/11 elsewhere
  EXPECT_EQ(found[2], 10U);  // 0.2 × 10/11, midway between the first and the peak
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_GT(std::abs(static_cast<int>(found[i]) - 20), 1) << "next to the peak";
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_GT(std::abs(static_cast<int>(found[i]) - static_cast<int>(found[j])), 1);
    }
  }
}

TEST(PointsToCheck, BelowTheThresholdAreNone) {
  const solver::ResponseCurve curve = resonance(11);
  EXPECT_TRUE(points_to_check(curve, Eigen::VectorXd::Constant(11, threshold), threshold).empty());
  Eigen::VectorXd one = Eigen::VectorXd::Zero(11);
  one[3] = 0.2;
  EXPECT_EQ(points_to_check(curve, one, threshold), Indices{3});
}

// Peaks are solved for anyway; at a fold there is no solution beside it.
TEST(PointsToCheck, ArePeaksAndFoldsNever) {
  solver::ResponseCurve curve = resonance(5);
  curve.points[1].slope.reset();
  curve.points[1].mark = solver::PointMark::fold;
  Indices found = points_to_check(curve, Eigen::VectorXd::Ones(5), threshold);
  std::ranges::sort(found);
  EXPECT_EQ(found, (Indices{0, 3, 4}));
}

}  // namespace
}  // namespace microslip::pipelines::test_points_to_check
