#include "contact/patch/point_motions.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace microslip::contact::test_point_motions {
namespace {

TEST(PointMotions, AreShapesTimesModalCoordinates) {
  ModalShapes shapes{Eigen::MatrixXd(1, 2), Eigen::MatrixXd(1, 2), {}};
  shapes.u << 1.0, 2.0;
  shapes.v << -1.0, 4.0;
  Harmonics q(1, 2);
  q.rows() << 1.0, 10.0, 2.0, 20.0, 3.0, 30.0;
  const PointMotion m = point_motions(shapes, q)[0];
  EXPECT_EQ(m.u_mean, 21.0);
  EXPECT_EQ(m.u_sin, 42.0);
  EXPECT_EQ(m.u_cos, 63.0);
  EXPECT_EQ(m.v_mean, 39.0);
  EXPECT_EQ(m.v_sin, 78.0);
  EXPECT_EQ(m.v_cos, 117.0);
}

TEST(PointMotions, RefuseOtherNumbersOfHarmonicsOrModes) {
  const ModalShapes shapes{Eigen::MatrixXd::Zero(1, 2), Eigen::MatrixXd::Zero(1, 2), {}};
  EXPECT_THROW((void)point_motions(shapes, Harmonics(2, 2)), std::invalid_argument);
  EXPECT_THROW((void)point_motions(shapes, Harmonics(1, 3)), std::invalid_argument);
  EXPECT_THROW((void)point_motions(shapes, Harmonics()), std::invalid_argument);
}

}  // namespace
}  // namespace microslip::contact::test_point_motions
