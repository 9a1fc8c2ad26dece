#include "pipelines/structure/campbell.hpp"

#include <gtest/gtest.h>

namespace microslip::pipelines::test_campbell {
namespace {

// ω² = ω₀² + SΩ²: the line ω = kΩ meets it at Ω² = ω₀²/(k² − S).
CampbellDiagram straight_in_squares(const Eigen::VectorXd& speeds) {
  CampbellDiagram diagram{speeds, Eigen::MatrixXd(speeds.size(), 2)};
  diagram.frequency.col(0) = (100.0 * 100.0 + 1.2 * speeds.array().square()).sqrt();
  diagram.frequency.col(1) = (300.0 * 300.0 - 0.5 * speeds.array().square()).sqrt();
  return diagram;
}

TEST(Campbell, FindsWhereEngineOrdersMeetModes) {
  const auto found = crossings(straight_in_squares(Eigen::VectorXd::LinSpaced(4, 0.0, 120.0)), 3);
  ASSERT_EQ(found.size(), 3U);
  EXPECT_EQ(found[0].engine_order, 2);
  EXPECT_EQ(found[0].mode, 0);
  EXPECT_NEAR(found[0].speed, 100.0 / std::sqrt(4.0 - 1.2), 1e-10);
  EXPECT_EQ(found[1].engine_order, 3);
  EXPECT_EQ(found[1].mode, 0);
  EXPECT_NEAR(found[1].speed, 100.0 / std::sqrt(9.0 - 1.2), 1e-10);
  EXPECT_EQ(found[2].mode, 1);
  EXPECT_NEAR(found[2].speed, 300.0 / std::sqrt(9.0 + 0.5), 1e-10);
}

TEST(Campbell, FindsNothingBelowTheFirstCrossing) {
  EXPECT_TRUE(crossings(straight_in_squares(Eigen::VectorXd::LinSpaced(3, 0.0, 30.0)), 3).empty());
}

}  // namespace
}  // namespace microslip::pipelines::test_campbell
