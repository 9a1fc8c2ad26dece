// What is hard: faces that are nearly plane or curved, and flexibilities of omitted modes that take
// more than there is (rows 12b and 19). Met in: imported meshes of real blades, contacts called
// "rigid", few modes. Right: axes of its own at every place of a curved face; told or refused with
// the number, the place and the remedy; never a negative stiffness or a slip direction that is
// none.

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "pipelines/model/contact_frame.hpp"
#include "pipelines/model/contact_stage.hpp"
#include "pipelines/system/scene_error.hpp"
#include "tests/support/box_mesh.hpp"

namespace microslip::pipelines::contact_faces {
namespace {

template <typename Error, typename Action>
std::string refusal(const Action& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

TEST(ContactFacesHard, FlexibilityThatIsNotPositiveIsRefused) {  // row 12b
  const Eigen::VectorXd residual = Eigen::Vector3d(1e-12, -2e-12, -5e-13);
  const auto stiffness = [&](std::optional<double> local) {
    return series_stiffness(local, residual, "normal", true);
  };
  const std::string rigid =
      refusal<RefusedError>([&] { static_cast<void>(stiffness(std::nullopt)); });
  EXPECT_NE(rigid.find("normal"), std::string::npos) << rigid;
  EXPECT_NE(rigid.find("2 of 3 points"), std::string::npos) << rigid;
  EXPECT_NE(rigid.find("residual = \"attachment\""), std::string::npos) << rigid;
  // 1/k_local of exactly what is missing leaves a stiffness without bound.
  EXPECT_NE(refusal<RefusedError>([&] { static_cast<void>(stiffness(5e11)); }), "accepted");
  EXPECT_TRUE((stiffness(4.9e11).array() > 0.0).all());
  EXPECT_EQ(stiffness(0.0), Eigen::Vector3d::Zero());
}

/// A box whose face x1 bulges by so much at its middle, of half a side.
mesh::Mesh bulging_box(double height) {
  const auto map = [=](const Eigen::Vector3d& x) -> Eigen::Vector3d {
    const double bulge = 16.0 * x.y() * (1.0 - x.y()) * x.z() * (1.0 - x.z());
    return x + Eigen::Vector3d(height * x.x() * bulge, 0.0, 0.0);
  };
  return test::box_mesh(mesh::ElementType::hex20, {{1.0, 1.0, 1.0}, {1, 4, 4}, map});
}

ContactDescription contact_on(const char* surface, const Eigen::Vector3d& slip) {
  ContactDescription contact;
  contact.surface = surface;
  contact.place = "scene.toml:9: contact.surface";
  contact.slip_place = "scene.toml:10: contact.slip_direction";
  contact.slip_direction = slip;
  return contact;
}

TEST(ContactFacesHard, AFaceThatIsNotPlaneHasAxesAtEveryPlace) {  // row 19
  ContactDescription contact = contact_on("x1", Eigen::Vector3d::UnitY());
  const Eigen::Matrix3d flat = contact_frame(bulging_box(0.0), contact);
  EXPECT_LT((flat.row(1).transpose() - Eigen::Vector3d::UnitX()).norm(), 1e-12);
  const Eigen::Matrix3d slightly = contact_frame(bulging_box(0.005), contact);
  EXPECT_LT((slightly.row(1).transpose() - Eigen::Vector3d::UnitX()).norm(), 1e-3);
  const mesh::Mesh bulging = bulging_box(0.1);
  EXPECT_FALSE(has_local_frames(bulging_box(0.005), contact));
  EXPECT_TRUE(has_local_frames(bulging, contact));
  const mesh::FaceFrame frame = face_frame(bulging, contact);
  const Eigen::Vector3d normal = Eigen::Vector3d(4.0, 1.0, -1.0).normalized();
  const Eigen::Matrix3d own = frame.at(normal);
  EXPECT_LT((own.row(1).transpose() - normal).norm(), 1e-15);
  EXPECT_LT((own * own.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-14);
  EXPECT_NEAR(own.row(0).dot(Eigen::Vector3d::UnitY().cross(normal)), 0.0, 1e-15)
      << "p is s, turned";
  contact.local_frames = false;
  EXPECT_FALSE(has_local_frames(bulging, contact)) << "off is obeyed";
  contact.local_frames = true;
  EXPECT_TRUE(has_local_frames(bulging_box(0.005), contact)) << "on as well";
  EXPECT_FALSE(has_local_frames(bulging_box(0.0), contact)) << "one frame is that of every place";
}

std::string refusal_of(const mesh::Mesh& mesh, const ContactDescription& contact,
                       const PatchSettings& settings = {}) {
  SceneDescription scene;
  scene.contacts = {contact};
  scene.settings.patches = {settings};
  return refusal<SceneError>([&] { require_frames(mesh, scene); });
}

TEST(ContactFacesHard, SlipAlongTheNormalOfOnePlaceIsRefusedWithItsPlace) {
  const mesh::Mesh bulging = bulging_box(0.3);  // its top and its corners look along x
  EXPECT_EQ(refusal_of(bulging, contact_on("x1", Eigen::Vector3d::UnitY())), "accepted");
  const std::string top = refusal_of(bulging, contact_on("x1", Eigen::Vector3d::UnitX()));
  EXPECT_TRUE(top.starts_with("scene.toml:10: ")) << top;
  EXPECT_NE(top.find("slip_direction: it is along the normal (1, "), std::string::npos) << top;
  EXPECT_NE(top.find("at (1, 0, 0) m"), std::string::npos) << top;
}

TEST(ContactFacesHard, WhatKnowsOnePlaneAloneIsRefusedOnACurvedFace) {
  ContactDescription contact = contact_on("x1", Eigen::Vector3d::UnitY());
  PatchSettings settings;
  settings.fit = PatchSettings::Fit::degree;
  EXPECT_EQ(refusal_of(bulging_box(0.005), contact, settings), "accepted");
  const std::string fitted = refusal_of(bulging_box(0.1), contact, settings);
  EXPECT_NE(fitted.find("contact.fit"), std::string::npos) << fitted;
  EXPECT_NE(fitted.find("effects.local_frames"), std::string::npos) << fitted;
  contact.preload_moment = {1.0, 0.0};
  const std::string tilted = refusal_of(bulging_box(0.1), contact);
  EXPECT_NE(tilted.find("contact.preload_moment"), std::string::npos) << tilted;
  contact.local_frames = false;
  EXPECT_EQ(refusal_of(bulging_box(0.1), contact), "accepted");
}

TEST(ContactFacesHard, SlipAlongTheNormalIsRefusedWithItsPlace) {
  const std::string along = refusal<SceneError>([&] {
    static_cast<void>(contact_frame(bulging_box(0.0), contact_on("x1", Eigen::Vector3d::UnitX())));
  });
  EXPECT_TRUE(along.starts_with("scene.toml:10: ")) << along;
  EXPECT_NE(along.find("slip_direction: it is along the normal (1, "), std::string::npos) << along;
}

}  // namespace
}  // namespace microslip::pipelines::contact_faces
