#include "pipelines/model/scene_places.hpp"

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "mesh/outer_faces.hpp"
#include "pipelines/import/named_points.hpp"
#include "pipelines/model/nodal_load.hpp"
#include "pipelines/scene/scene_file.hpp"
#include "tests/support/box_mesh.hpp"

namespace microslip::pipelines::test_scene_places {
namespace {

const char* const text = R"(
[model]
kind = "mesh"
file = "box.msh"
[material]
youngs_modulus = 2e11
poissons_ratio = 0.3
density = 7800
[supports]
clamped = ["z0"]
[[contact]]
surface = "x1"
slip_direction = [0, 0, 1]
friction_coefficient = 0.3
normal_stiffness = 1e10
tangential_stiffness = 1e10
[[contact]]
surface = "y1"
slip_direction = [0, 0, 1]
friction_coefficient = 0.3
normal_stiffness = 1e10
tangential_stiffness = 1e10
[excitation]
forces = [ { at = "corner", direction = [1, 0, 0], amplitude = 1 } ]
[response]
output = { at = [0, 0, 0.4], direction = [0, 1, 0] }
frequency = [100, 200]
preload = ["free", 1200, -600, { gap = 2e-6 }, "stuck"]
)";

/// 0.1 x 0.2 x 0.4 m: x1 has 0.08 m², y1 0.04 m².
mesh::Mesh box(const SceneDescription& scene) {
  mesh::Mesh mesh = test::box_mesh(mesh::ElementType::hex8, {{0.1, 0.2, 0.4}, {1, 2, 4}, {}});
  name_points(mesh, scene);
  return mesh;
}

TEST(ScenePlaces, PreloadIsToldAsPressureAndAsGap) {
  const SceneDescription scene = parse_scene(text, "box.toml", "/", {});
  for (const std::size_t contact : {0U, 1U}) {  // loads are shared by area: one pressure, one gap
    const auto preloads = patch_preloads(box(scene), scene, contact);
    ASSERT_EQ(preloads.size(), 3U);
    EXPECT_NEAR(preloads[0].pressure, 1200.0 / 0.12, 1e-9);
    EXPECT_NEAR(preloads[1].gap, 600.0 / (1e10 * 0.12), 1e-20);
    EXPECT_EQ(preloads[2].gap, 2e-6);
  }
  const SceneDescription in_series =
      parse_scene(text, "box.toml", "/", {"modes.residual=stiffness"});
  EXPECT_TRUE(patch_preloads(box(in_series), in_series, 0)[1].gap_needs_modes);
}

TEST(ScenePlaces, EachHasALineWithNodesAreaAndCentre) {
  const SceneDescription scene = parse_scene(text, "box.toml", "/", {});
  const std::vector<std::string> lines = describe_places(box(scene), scene);
  const std::vector<std::string> expected{
      "clamped z0: 6 nodes, 0.02 m^2 at (0.05, 0.1, 0) m",
      "force corner: 1 N, phase 0 degrees, along (1, 0, 0), 1 node at (0.1, 0.2, 0.4) m",
      "output (0, 0, 0.4): along (0, 1, 0), 1 node at (0, 0, 0.4) m",
      "contact x1: 15 nodes, 0.08 m^2 at (0.1, 0.1, 0.2) m, flat to 0 m",
      "  p (0, 0, 1) slip, q (1, 0, 0) out of the body, r (0, 1, 0)",
      "  preload 1200 N: 1e+04 Pa; -600 N: a gap of 5e-07 m; a gap of 2e-06 m",
      "contact y1: 10 nodes, 0.04 m^2 at (0.05, 0.2, 0.2) m, flat to 0 m",
      "  p (0, 0, 1) slip, q (0, 1, 0) out of the body, r (-1, 0, 0)",
      "  preload 1200 N: 1e+04 Pa; -600 N: a gap of 5e-07 m; a gap of 2e-06 m",
      "point (0, 0, 0.4): the nearest node, at (0, 0, 0.4) m, is 0 m away"};
  EXPECT_EQ(lines, expected);
}

TEST(ScenePlaces, APhaseWithoutAUnitIsInDegrees) {
  for (const char* phase : {"90", "90 deg", "1.5707963267948966 rad"}) {
    const SceneDescription scene =
        parse_scene(text, "box.toml", "/", {fmt::format("excitation.forces[0].phase={}", phase)});
    EXPECT_TRUE(describe_places(box(scene), scene)[1].starts_with(
        "force corner: 1 N, phase 90 degrees, along"))
        << phase;
    const Eigen::MatrixX2d loads = excitation_loads(box(scene), scene.forces);
    EXPECT_NEAR(loads.col(0).norm(), 0.0, 1e-15) << phase;  // F sin(θ + 90°) = F cos θ
    EXPECT_NEAR(loads.col(1).norm(), 1.0, 1e-15) << phase;
  }
}

TEST(ScenePlaces, ASetOfNodesThatHoldsFacesHasTheirAreaAndCentroid) {
  const SceneDescription scene = parse_scene(text, "box.toml", "/", {"excitation.forces[0].at=x1"});
  const mesh::Mesh with_surfaces = box(scene);
  mesh::Mesh::NodeSets sets = with_surfaces.node_sets();
  for (const std::string& name : with_surfaces.surface_names()) {
    sets[name] = with_surfaces.surface(name).nodes;
  }
  Eigen::MatrixX3d nodes = with_surfaces.nodes();
  for (const Eigen::Index node : sets["x1"]) nodes(node, 2) *= nodes(node, 2) / 0.4;  // more below
  const mesh::Mesh mesh(nodes, with_surfaces.elements(), {}, sets);
  const std::vector<std::string> lines = describe_places(mesh, scene);
  EXPECT_EQ(lines[0], "clamped z0: 6 nodes, 0.02 m^2 at (0.05, 0.1, 0) m");
  EXPECT_EQ(
      lines[1],
      "force x1: 1 N, phase 0 degrees, along (1, 0, 0), 15 nodes, 0.08 m^2 at (0.1, 0.1, 0.2) m")
      << "the nodes of whole faces are loaded as these: the force acts at their centroid";
  EXPECT_EQ(lines[3], "contact x1: 15 nodes, 0.08 m^2 at (0.1, 0.1, 0.2) m, flat to 0 m");
}

TEST(ScenePlaces, ForcesTakeTheSurfaceAndSupportsTheSetOfOneName) {
  const SceneDescription scene = parse_scene(text, "box.toml", "/", {"excitation.forces[0].at=z0"});
  const mesh::Mesh plain = box(scene);
  std::map<std::string, std::vector<mesh::FaceBlock>> surfaces;
  for (const std::string& name : plain.surface_names()) surfaces[name] = plain.surface(name).faces;
  mesh::Mesh::NodeSets sets = plain.node_sets();
  sets["z0"] = {plain.surface("z0").nodes.front()};
  const mesh::Mesh mesh(plain.nodes(), plain.elements(), surfaces, sets);
  const std::vector<std::string> lines = describe_places(mesh, scene);
  EXPECT_TRUE(lines[0].starts_with("clamped z0: 1 node")) << lines[0];
  EXPECT_EQ(
      lines[1],
      "force z0: 1 N, phase 0 degrees, along (1, 0, 0), 6 nodes, 0.02 m^2 at (0.05, 0.1, 0) m");
}

TEST(ScenePlaces, StaticLoadsAreAmongThem) {
  const SceneDescription scene =
      parse_scene(text, "box.toml", "/",
                  {"static.forces=[{at=\"corner\", direction=[0, 0, 1], amplitude=1}]",
                   "static.pressure=[{surface=\"x0\", value=10}, {surface=\"y0\", value=-10}]",
                   "contact[0].preload=static", "contact[1].preload=static"});
  const std::vector<std::string> lines = describe_places(box(scene), scene);
  EXPECT_EQ(lines[3], "static force corner: 1 N along (0, 0, 1), 1 node at (0.1, 0.2, 0.4) m");
  EXPECT_EQ(lines[4], "pressure x0: along (1, 0, 0), 15 nodes, 0.08 m^2 at (0, 0.1, 0.2) m");
  EXPECT_EQ(lines[5], "pressure y0: along (0, -1, 0), 10 nodes, 0.04 m^2 at (0.05, 0, 0.2) m")
      << "suction pulls";
}

TEST(OuterFaces, AreTheSkinOfTheMesh) {
  const SceneDescription scene = parse_scene(text, "box.toml", "/", {});
  EXPECT_EQ(mesh::outer_faces(box(scene)).size(), 2U * (2 + 4 + 8)) << "cells on the six sides";
  const mesh::Mesh tetrahedra =
      test::box_mesh(mesh::ElementType::tet10, {{1, 1, 1}, {1, 1, 1}, {}});
  const auto faces = mesh::outer_faces(tetrahedra);
  EXPECT_EQ(faces.size(), 12U);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();  // of outward areas: they close
  double volume = 0.0;
  for (const auto& face : faces) {
    EXPECT_EQ(face[3], -1);
    const Eigen::Vector3d a = tetrahedra.nodes().row(face[0]);
    const Eigen::Vector3d b = tetrahedra.nodes().row(face[1]);
    const Eigen::Vector3d c = tetrahedra.nodes().row(face[2]);
    const Eigen::Vector3d area = 0.5 * (b - a).cross(c - a);
    sum += area;
    volume += area.dot(a) / 3.0;
  }
  EXPECT_NEAR(sum.norm(), 0.0, 1e-15);
  EXPECT_NEAR(volume, 1.0, 1e-14) << "outward";
}

}  // namespace
}  // namespace microslip::pipelines::test_scene_places
