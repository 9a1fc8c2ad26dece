#include "pipelines/import/face_choice.hpp"

#include <string>

#include <gtest/gtest.h>

#include "pipelines/system/scene_error.hpp"

namespace microslip::pipelines::test_face_choice {
namespace {

/// Sides of the box [0, 1] x [0, 2] x [0, 1] m, numbers 1 to 6: x = 0, x = 1, y = 0, y = 2, z = 0,
/// z = 1.
mesh::StepGeometry box() {
  mesh::StepGeometry geometry;
  geometry.volume = 2.0;
  const Eigen::Vector3d size(1.0, 2.0, 1.0);
  std::vector<Eigen::Vector3d> nodes;
  for (int axis = 0; axis < 3; ++axis) {
    for (const int end : {0, 1}) {
      const Eigen::Vector3d a = Eigen::Vector3d::Unit((axis + 1) % 3).cwiseProduct(size);
      const Eigen::Vector3d b = Eigen::Vector3d::Unit((axis + 2) % 3).cwiseProduct(size);
      const Eigen::Vector3d o = end * size[axis] * Eigen::Vector3d::Unit(axis);
      mesh::StepFace& face = geometry.faces.emplace_back();
      face.number = 2 * axis + end + 1;
      face.kind = "plane";
      face.area = a.norm() * b.norm();
      face.centre = o + 0.5 * (a + b);
      face.normal = (2 * end - 1) * Eigen::Vector3d::Unit(axis);
      for (const Eigen::Vector3d& x : {o, Eigen::Vector3d(o + a), Eigen::Vector3d(o + a + b), o,
                                       Eigen::Vector3d(o + a + b), Eigen::Vector3d(o + b)}) {
        nodes.push_back(x);
      }
      geometry.owner.insert(geometry.owner.end(), 2, face.number);
    }
  }
  const auto n = std::ssize(nodes);
  geometry.nodes.resize(n, 3);
  geometry.triangles.resize(n / 3, 3);
  for (Eigen::Index i = 0; i < n; ++i) {
    geometry.nodes.row(i) = nodes[static_cast<std::size_t>(i)];
    geometry.triangles(i / 3, i % 3) = i;
  }
  return geometry;
}

FaceChoice at(double x, double y, double z) {
  FaceChoice choice;
  choice.point = Eigen::Vector3d(x, y, z);
  return choice;
}

FaceChoice facing(const Eigen::Vector3d& normal) {
  FaceChoice choice;
  choice.normal = normal.normalized();
  return choice;
}

std::string refusal(const FaceChoice& choice) {
  try {
    static_cast<void>(chosen_face(box(), choice, "a.toml:3: faces.tip"));
  } catch (const SceneError& error) {
    return error.what();
  }
  return "no error";
}

TEST(FaceChoice, PointMeansTheFaceItIsOn) {
  EXPECT_EQ(chosen_face(box(), at(1.0, 0.7, 0.3), ""), 2);
  EXPECT_EQ(chosen_face(box(), at(0.4, 2.004, 0.3), ""), 4);  // off by 0.2 % of the body
}

TEST(FaceChoice, DistanceIsThatOfTheFaceNotOfItsPlane) {
  const auto away = distances(box(), {1.5, -1.0, 0.5});
  EXPECT_NEAR(away[1], std::hypot(0.5, 1.0), 1e-12);
  EXPECT_NEAR(away[3], std::hypot(0.5, 3.0), 1e-12);
}

TEST(FaceChoice, PointOffTheBodyOrOnAnEdgeMeansNone) {
  EXPECT_NE(refusal(at(1.1, 0.7, 0.3)).find("on no face; nearest is 2 (plane"), std::string::npos);
  EXPECT_NE(refusal(at(1.0, 0.7, 1.0)).find("fits 2 faces: 2 (plane"), std::string::npos);
  EXPECT_TRUE(refusal(at(1.0, 0.7, 1.0)).starts_with("a.toml:3: faces.tip: "));
}

TEST(FaceChoice, NormalMeansTheFaceThatHasIt) {
  EXPECT_EQ(chosen_face(box(), facing({0.0, 1.0, 0.01}), ""), 4);
  EXPECT_NE(refusal(facing({0.0, 1.0, 0.1})).find("fits no face; nearest is 4"), std::string::npos);
}

TEST(FaceChoice, OfFacesWithOneNormalTheNearerIsMeant) {
  mesh::StepGeometry geometry = box();
  geometry.faces[0].normal = Eigen::Vector3d::UnitX();  // as the wall of a slot
  FaceChoice choice = facing(Eigen::Vector3d::UnitX());
  EXPECT_THROW(static_cast<void>(chosen_face(geometry, choice, "")), SceneError);
  choice.near = Eigen::Vector3d(-0.3, 1.0, 0.5);
  EXPECT_EQ(chosen_face(geometry, choice, ""), 1);
  choice.near = Eigen::Vector3d(0.5, 1.0, 0.5);  // between both
  EXPECT_THROW(static_cast<void>(chosen_face(geometry, choice, "")), SceneError);
}

TEST(FaceChoice, FaceMeantTwiceIsRefused) {
  FaceDescription face{"tip", {at(1.0, 0.7, 0.3), facing(Eigen::Vector3d::UnitX())}, "here"};
  EXPECT_THROW(static_cast<void>(chosen_faces(box(), face)), SceneError);
  face.choices[1] = facing(Eigen::Vector3d::UnitY());
  EXPECT_EQ(chosen_faces(box(), face), (std::vector<int>{2, 4}));
}

}  // namespace
}  // namespace microslip::pipelines::test_face_choice
