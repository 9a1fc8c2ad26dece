#include "pipelines/import/named_points.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include <fmt/format.h>

#include "mesh/mesh.hpp"
#include "pipelines/effects/model_family.hpp"
#include "pipelines/response/response_stage.hpp"
#include "pipelines/scene/scene_file.hpp"
#include "pipelines/structure/structure_stage.hpp"
#include "pipelines/system/scene_error.hpp"
#include "pipelines/system/temporary_folder.hpp"
#include "tests/support/box_mesh.hpp"

namespace microslip::pipelines::test_named_points {
namespace {

/// A box of 0.1 x 0.2 x 0.4 m with elements of 0.1 m.
const char* const box_text = R"(
[model]
kind = "mesh"
file = "box.msh"
[material]
youngs_modulus = 2e11
poissons_ratio = 0.3
density = 7800
[points]
middle = ["50 mm", "100 mm", 0.21]
top = "z1"
[supports]
clamped = ["z0"]
[excitation]
forces = [ { at = "middle", direction = [1, 0, 0], amplitude = 1 } ]
[response]
output = { at = ["100 mm", 0.0, 0.4], direction = [0, 1, 0] }
frequency = [100, 200]
)";

SceneDescription box_scene(const std::vector<std::string>& overrides = {}) {
  return parse_scene(box_text, "box.toml", "/", overrides);
}

mesh::Mesh box() {
  return test::box_mesh(mesh::ElementType::hex8, {{0.1, 0.2, 0.4}, {1, 2, 4}, {}});
}

mesh::Mesh named_box(const SceneDescription& scene) {
  mesh::Mesh mesh = box();
  name_points(mesh, scene);
  return mesh;
}

std::string complaint(const std::vector<std::string>& overrides) {
  try {
    static_cast<void>(named_box(box_scene(overrides)));
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

void expect_complaint(const std::vector<std::string>& overrides,
                      const std::vector<std::string>& parts) {
  const std::string message = complaint(overrides);
  for (const std::string& part : parts) {
    EXPECT_NE(message.find(part), std::string::npos) << part << " in: " << message;
  }
}

TEST(NamedPoints, CoordinatesAreTheNearestNode) {
  const SceneDescription scene = box_scene();
  const mesh::Mesh mesh = named_box(scene);
  const auto points = locate_points(mesh, scene);
  ASSERT_EQ(points.size(), 2U);
  EXPECT_EQ(points[0].name, "middle");
  const Eigen::RowVector3d node = mesh.nodes().row(mesh.node_set("middle").front());
  EXPECT_EQ(mesh.node_set("middle").size(), 1U);
  EXPECT_NEAR((node - Eigen::RowVector3d(0.0, 0.1, 0.2)).norm(), 0.0, 1e-15);
  EXPECT_NEAR(points[0].distance, std::hypot(0.05, 0.01), 1e-15);
  EXPECT_NEAR(points[0].element_size, 0.1 * std::sqrt(3.0), 1e-15) << "the diagonal of a cell";
  EXPECT_NEAR(points[1].distance, 0.0, 1e-15);
  EXPECT_EQ(scene.response->output.at, points[1].name);
}

TEST(NamedPoints, AnotherNameStandsForTheSetItself) {
  const SceneDescription scene =
      box_scene({"response.output.at=top", R"(supports.clamped=["top"])"});
  EXPECT_EQ(scene.response->output.at, "z1");
  EXPECT_EQ(scene.clamped.front(), "z1");
  EXPECT_EQ(named_box(scene).node_set("top"), box().node_set("z1"));
}

TEST(NamedPoints, SurviveInTheWrittenScene) {
  const SceneDescription scene =
      box_scene({R"(points.B'=["1 cm", 0, 0])", "points.middle=[0,0,0]"});
  const SceneDescription again = parse_scene(scene.complete_toml, "scene.toml", "/", {});
  EXPECT_EQ(again.complete_toml, scene.complete_toml);
  ASSERT_EQ(again.points.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(again.points[i].name, scene.points[i].name);
    EXPECT_EQ(again.points[i].of, scene.points[i].of);
  }
  EXPECT_EQ(again.response->output.at, scene.response->output.at);
}

TEST(NamedPoints, WhatIsWrongIsToldWhereItStands) {
  expect_complaint({"points.middle=[0, 1]"}, {"points.middle", "three coordinates"});
  expect_complaint({R"(points.middle=[0, 1, "2 s"])"}, {"points.middle", "\"s\""});
  expect_complaint({"points.middle=3"}, {"points.middle", "coordinates [x, y, z]"});
  expect_complaint({R"(points.middle="zz")"}, {"points.middle", "nothing is named \"zz\"", "z1"});
  expect_complaint({"points.z1=[0, 0, 0]"}, {"points.z1", "the mesh has a \"z1\" already"});
  expect_complaint({R"(points.corner="z0")"}, {"points.corner", "already"});
  expect_complaint({"points.middle=[0, 0, 400]"},
                   {"points.middle", "400 m from the nearest node", "millimetres"});
  expect_complaint({"response.output.at=[0, 1]"}, {"response.output.at", "three coordinates"});
  expect_complaint({"excitation.forces[0].at=7"}, {"excitation.forces.at", "a name"});
  try {
    static_cast<void>(parse_scene(std::string(box_text) + "\n", "box.toml", "/", {}));
    mesh::Mesh other = test::box_mesh(mesh::ElementType::hex8, {{1e-3, 1e-3, 1e-3}, {1, 1, 1}, {}});
    name_points(other, box_scene());
    FAIL() << "a point far outside was taken";
  } catch (const SceneError& error) {
    EXPECT_TRUE(std::string(error.what()).starts_with("box.toml:10: points.middle:"))
        << error.what();
  }
}

TEST(NamedPoints, CoordinatesGiveTheCurveOfTheName) {
  const std::string text = R"(
[model]
kind = "blade"
element_size = "15 mm"
[material]
youngs_modulus = 2.1e11
poissons_ratio = 0.3
density = 7800
[supports]
clamped = ["root"]
[modes]
count = 3
[excitation]
forces = [ { at = "B", direction = [1, 0, 0], amplitude = 1 } ]
[response]
output = { at = "A", direction = [1, 0, 0] }
frequency = [280, 320]
)";
  const SceneDescription named = parse_scene(text, "blade.toml", "/", {});
  const TemporaryFolder folder;
  const SolvedStructure blade = solved_structure(named, folder.path() / "mesh.msh");
  const auto coordinates = [&](const std::string& name) {
    const Eigen::RowVector3d node = blade.mesh.nodes().row(blade.mesh.node_set(name).front());
    return fmt::format("[{:.17g}, {:.17g}, {:.17g}]", node.x(), node.y(), node.z());
  };
  const SceneDescription placed =
      parse_scene(text, "blade.toml", "/",
                  {"response.output.at=" + coordinates("A"), "points.here=" + coordinates("B"),
                   "excitation.forces[0].at=here"});
  SolvedStructure again{blade.mesh, blade.modes};
  name_points(again.mesh, placed);
  const auto curve = [](const SceneDescription& scene, const SolvedStructure& structure) {
    std::vector<std::string> warnings;
    return trace_curve(model_of(scene, &structure, warnings), scene, {"free", LimitName::free},
                       [](const auto&) { return true; })
        .curve.points;
  };
  const auto by_name = curve(named, blade);
  const auto by_place = curve(placed, again);
  ASSERT_GT(by_name.size(), 10U);
  ASSERT_EQ(by_name.size(), by_place.size());
  for (std::size_t i = 0; i < by_name.size(); ++i) {
    EXPECT_EQ(by_name[i].frequency, by_place[i].frequency);
    EXPECT_EQ(by_name[i].amplitude, by_place[i].amplitude);
  }
}

}  // namespace
}  // namespace microslip::pipelines::test_named_points
