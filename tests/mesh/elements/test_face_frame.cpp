#include "mesh/face_frame.hpp"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

namespace microslip::mesh::test_face_frame {
namespace {

const Eigen::Vector3d slip(0.2, 3.0, -1.0);
const Eigen::Vector3d normal = Eigen::Vector3d(1.0, 0.5, 2.0).normalized();

TEST(FaceFrame, AxesArePerpendicularWithTheNormalAsSecond) {
  const Eigen::Matrix3d axes = axes_at(normal, slip);
  EXPECT_LT((axes * axes.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-15);
  EXPECT_EQ(axes.row(1).transpose(), normal);
  EXPECT_LT((axes.row(2) - axes.row(0).cross(axes.row(1))).norm(), 1e-15);
}

TEST(FaceFrame, SlipDirectionIsInThePlaneOfPAndTheNormal) {
  const Eigen::Matrix3d axes = axes_at(normal, slip);
  EXPECT_NEAR(axes.row(2).dot(slip), 0.0, 1e-14);
  EXPECT_GT(axes.row(0).dot(slip), 0.0);
}

TEST(FaceFrame, WithoutASlipDirectionPlacesHaveTheFrameOfTheFace) {
  const FaceFrame face(axes_at(Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY()));
  EXPECT_FALSE(face.is_local());
  EXPECT_EQ(face.at(normal), face.plane);
}

TEST(FaceFrame, AxesOfAPlaceDoNotKnowTheFrameOfTheFace) {
  const FaceFrame one(axes_at(Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY()), slip);
  const FaceFrame other(axes_at(Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitX()), slip);
  EXPECT_TRUE(one.is_local());
  EXPECT_EQ(one.at(normal), other.at(normal));
  EXPECT_EQ(one.at(normal), axes_at(normal, slip));
}

}  // namespace
}  // namespace microslip::mesh::test_face_frame
