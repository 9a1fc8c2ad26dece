#include "mesh/refined_mesh.hpp"

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "mesh/outer_faces.hpp"
#include "tests/support/box_mesh.hpp"

namespace microslip::mesh::test_refined_mesh {
namespace {

const test::BoxGrid distorted_grid{{1.0, 1.0, 1.0}, {2, 3, 2}, test::distorted};

Eigen::Index n_of(const Mesh& mesh, Solid kind) {
  Eigen::Index n = 0;
  for (const ElementBlock& block : mesh.elements()) {
    if (solid(block.type) == kind) n += block.connectivity.rows();
  }
  return n;
}

/// The same body: its surfaces are faces of it, which Mesh has checked, with the same areas.
void expect_same_body(const Mesh& mesh, const Mesh& finer, double tolerance) {
  EXPECT_NEAR(finer.volume(), mesh.volume(), tolerance * mesh.volume());
  EXPECT_EQ(finer.surface_names(), mesh.surface_names());
  for (const std::string& name : mesh.surface_names()) {
    const double area = mesh.surface(name).area;
    EXPECT_NEAR(finer.surface(name).area, area, 1e-3 * area) << name;  // of cells: midpoints
  }
  EXPECT_EQ(outer_faces(finer).size(), 4 * outer_faces(mesh).size());
}

// Shape functions of a part are those of the whole, but for pyramids inside, whose are rational:
// rounding, else what a curved pyramid differs by.
TEST(RefinedMesh, IsTheSameBodyInSmallerElementsOfEveryType) {
  for (const ElementType type : all_element_types) {
    SCOPED_TRACE(name(type));
    const Mesh mesh = test::box_mesh(type, distorted_grid);
    const Mesh finer = refined(mesh);
    const Eigen::Index n_pyramids = n_of(mesh, Solid::pyramid);
    EXPECT_EQ(finer.n_elements(), 8 * mesh.n_elements() + 2 * n_pyramids);
    EXPECT_EQ(n_of(finer, Solid::pyramid), 6 * n_pyramids);
    for (const ElementBlock& block : finer.elements()) {
      EXPECT_EQ(is_quadratic(block.type), is_quadratic(type));
    }
    expect_same_body(mesh, finer, 1e-12);
  }
}

TEST(RefinedMesh, OfAllSolidsConforms) {
  for (const int order : {1, 2}) {
    SCOPED_TRACE(order);
    const test::BoxGrid grid{{1.0, 1.0, 1.0}, {4, 2, 2}, test::distorted};
    const Mesh mesh = test::straight_mixed_box_mesh(order, grid);
    const Mesh finer = refined(mesh);
    expect_same_body(mesh, finer, 1e-12);
    expect_same_body(finer, refined(finer), 1e-12);
  }
}

// One node at each place, the given ones first: of 2 × 3 × 2 cubes those of 4 × 6 × 4.
TEST(RefinedMesh, KeepsTheNodesAndMakesOneAtEachPlace) {
  const Mesh linear = test::box_mesh(ElementType::hex8, distorted_grid);
  const Mesh finer = refined(linear);
  EXPECT_EQ(finer.n_nodes(), 5 * 7 * 5);
  EXPECT_EQ(finer.nodes().topRows(linear.n_nodes()), linear.nodes());
  const Mesh quadratic = test::box_mesh(ElementType::hex20, distorted_grid);
  const Mesh alike = test::box_mesh(ElementType::hex20, {{1.0, 1.0, 1.0}, {4, 6, 4}, {}});
  EXPECT_EQ(refined(quadratic).n_nodes(), alike.n_nodes());
}

Mesh with_set(const Mesh& mesh, const std::vector<Eigen::Index>& nodes) {
  return {mesh.nodes(), mesh.elements(), {}, {{"set", nodes}}};
}

std::vector<Eigen::Index> nodes_where(const Mesh& mesh, bool (*is_there)(Eigen::Vector3d)) {
  std::vector<Eigen::Index> nodes;
  for (Eigen::Index i = 0; i < mesh.n_nodes(); ++i) {
    if (is_there(mesh.nodes().row(i))) nodes.push_back(i);
  }
  return nodes;
}

TEST(QuadraticMesh, IsTheSameBodyWithANodeOnEachEdge) {
  for (const ElementType type : all_element_types) {
    SCOPED_TRACE(name(type));
    const Mesh mesh = test::box_mesh(type, distorted_grid);
    const Mesh finer = quadratic(mesh);
    EXPECT_TRUE(has_midside_nodes(finer));
    EXPECT_EQ(has_midside_nodes(mesh), is_quadratic(type));
    EXPECT_EQ(finer.n_elements(), mesh.n_elements());
    EXPECT_EQ(finer.nodes().topRows(mesh.n_nodes()), mesh.nodes());
    EXPECT_NEAR(finer.volume(), mesh.volume(), 1e-12 * mesh.volume());
    EXPECT_EQ(finer.surface_names(), mesh.surface_names());
    for (const std::string& surface : mesh.surface_names()) {
      EXPECT_NEAR(finer.surface(surface).area, mesh.surface(surface).area, 1e-12) << surface;
    }
  }
  const test::BoxGrid grid{{1.0, 1.0, 1.0}, {2, 3, 2}, {}};
  EXPECT_EQ(quadratic(test::box_mesh(ElementType::hex8, grid)).n_nodes(),
            test::box_mesh(ElementType::hex20, grid).n_nodes());
}

TEST(QuadraticMesh, CompletesSetsOfNodesOnFacesAndEdges) {
  bool (*const places[])(Eigen::Vector3d) = {
      [](Eigen::Vector3d x) { return x.x() == 0.0; },
      [](Eigen::Vector3d x) { return x.x() == 0.0 && x.z() == 1.0; },
      [](Eigen::Vector3d x) { return x.norm() == 0.0; },
  };
  for (const ElementType type : {ElementType::tet4, ElementType::hex8, ElementType::wedge6}) {
    const Mesh mesh = test::box_mesh(type, {{1.0, 1.0, 1.0}, {2, 2, 2}, {}});
    for (const auto is_there : places) {
      const Mesh finer = quadratic(with_set(mesh, nodes_where(mesh, is_there)));
      EXPECT_EQ(finer.node_set("set"), nodes_where(finer, is_there)) << name(type);
    }
  }
}

// A quarter of a ring in one element: the nodes that join lie on its parabola, not on chords.
TEST(RefinedMesh, IsCurvedAsItsElementsAre) {
  const auto ring = [](const Eigen::Vector3d& x) {
    const double angle = 0.5 * x.y();
    return Eigen::Vector3d((2.0 + x.x()) * std::cos(angle), (2.0 + x.x()) * std::sin(angle), x.z());
  };
  const Mesh mesh = test::box_mesh(ElementType::hex20, {{1.0, 1.0, 1.0}, {1, 1, 1}, ring});
  const Mesh finer = refined(mesh);
  expect_same_body(mesh, finer, 1e-12);
  for (const Eigen::Index node : finer.surface("x1").nodes) {
    EXPECT_NEAR(finer.nodes().row(node).head<2>().norm(), 3.0, 2e-3);
  }
}

// What holds a face or an edge holds all of it, and nothing beside.
TEST(RefinedMesh, CompletesSetsOfNodesOnFacesAndEdges) {
  bool (*const places[])(Eigen::Vector3d) = {
      [](Eigen::Vector3d x) { return x.x() == 0.0; },
      [](Eigen::Vector3d x) { return x.x() == 0.0 || x.y() == 0.0; },
      [](Eigen::Vector3d x) { return x.x() == 0.0 && x.z() == 1.0; },
      [](Eigen::Vector3d x) { return x.norm() == 0.0; },
  };
  for (const ElementType type : all_element_types) {
    SCOPED_TRACE(name(type));
    const Mesh mesh = test::box_mesh(type, {{1.0, 1.0, 1.0}, {2, 2, 2}, {}});
    for (const auto is_there : places) {
      const Mesh finer = refined(with_set(mesh, nodes_where(mesh, is_there)));
      EXPECT_EQ(finer.node_set("set"), nodes_where(finer, is_there));
    }
  }
}

TEST(RefinedMesh, LeavesAFaceOfNodesAFace) {
  const Mesh box = test::box_mesh(ElementType::tet10, {{1.0, 1.0, 1.0}, {2, 2, 2}, {}});
  const Mesh mesh = with_set(box, box.surface("x1").nodes);
  ASSERT_TRUE(mesh.has_faces("set"));
  const Mesh finer = refined(mesh);
  ASSERT_TRUE(finer.has_faces("set"));
  EXPECT_NEAR(finer.surface("set").area, 1.0, 1e-12);
}

TEST(RefinedMesh, TellsWhatTheGivenOneTells) {
  Mesh mesh = test::box_mesh(ElementType::tet4, {{1.0, 1.0, 1.0}, {1, 1, 1}, {}});
  mesh.add_remark("from a file");
  mesh.name_nodes("A", {0});
  const Mesh finer = refined(mesh);
  EXPECT_EQ(finer.remarks(), mesh.remarks());
  EXPECT_EQ(finer.node_set("A"), std::vector<Eigen::Index>{0});
}

}  // namespace
}  // namespace microslip::mesh::test_refined_mesh
