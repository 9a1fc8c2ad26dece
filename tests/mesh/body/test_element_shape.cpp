#include "mesh/element_shape.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "mesh/shape_functions.hpp"
#include "tests/mesh/given_mesh.hpp"

namespace microslip::mesh::test_element_shape {
namespace {

using std::numbers::pi;

constexpr double rounding = 1e-14;  // of a handful of products

Eigen::MatrixX3d regular_tetrahedron() {
  Eigen::MatrixX3d nodes(4, 3);
  nodes << 1, 1, 1, -1, 1, -1, 1, -1, -1, -1, -1, 1;
  return nodes;
}

TEST(ElementShape, OfARegularTetrahedronIsTheKnownOne) {
  const ElementShape shape = element_shape(ElementType::tet4, regular_tetrahedron());
  EXPECT_NEAR(shape.aspect_ratio, std::sqrt(1.5), rounding);
  EXPECT_NEAR(shape.smallest_angle, std::acos(1.0 / 3.0), rounding);
  EXPECT_NEAR(shape.largest_angle, std::acos(1.0 / 3.0), rounding);
}

TEST(ElementShape, OfABrickIsItsLongestOverItsShortestEdge) {
  Eigen::MatrixX3d nodes = reference_nodes(ElementType::hex20);
  nodes.col(0) *= 7.0;
  nodes.col(2) *= 0.5;
  const ElementShape shape = element_shape(ElementType::hex20, nodes);
  EXPECT_NEAR(shape.aspect_ratio, 14.0, 14.0 * rounding);
  EXPECT_NEAR(shape.smallest_angle, 0.5 * pi, rounding);
  EXPECT_NEAR(shape.largest_angle, 0.5 * pi, rounding);
}

TEST(ElementShape, OfAWedgeOnAnEquilateralTriangleIsTheKnownOne) {
  Eigen::MatrixX3d nodes = reference_nodes(ElementType::wedge6);
  nodes.col(0) += 0.5 * nodes.col(1);
  nodes.col(1) *= 0.5 * std::sqrt(3.0);
  const ElementShape shape = element_shape(ElementType::wedge6, nodes);  // edges 1 and 2
  EXPECT_NEAR(shape.aspect_ratio, 4.0 / std::sqrt(3.0), 10.0 * rounding);
  EXPECT_NEAR(shape.smallest_angle, pi / 3.0, rounding);
  EXPECT_NEAR(shape.largest_angle, 0.5 * pi, rounding);
}

// All edges alike: half an octahedron.
TEST(ElementShape, OfHalfAnOctahedronIsTheKnownOne) {
  Eigen::MatrixX3d nodes = reference_nodes(ElementType::pyramid5);
  nodes(4, 2) = std::sqrt(2.0);
  const ElementShape shape = element_shape(ElementType::pyramid5, nodes);
  EXPECT_NEAR(shape.aspect_ratio, std::sqrt(2.0), 10.0 * rounding);
  EXPECT_NEAR(shape.smallest_angle, std::acos(1.0 / std::sqrt(3.0)), rounding);
  EXPECT_NEAR(shape.largest_angle, std::acos(-1.0 / 3.0), rounding);
}

/// Four corners of a square, two of them lifted: every edge is long, the height is small.
Eigen::MatrixX3d sliver(double lift) {
  Eigen::MatrixX3d nodes(4, 3);
  nodes << -1, 0, 0, 0, -1, lift, 1, 0, 0, 0, 1, lift;
  return nodes;
}

// Row 30. Hard: a sliver has no short edge and no small face, and hardly a volume.
// Met in: meshes of tetrahedra.
// Right: told by its number.
//
// Lines at height 0 and `lift`: the dihedral at the edge 0–2 is π − 2 atan(lift), at 0–1 it is
// small.
TEST(ElementShape, SeesASliverWithoutAnyShortEdge) {
  const double lift = 2e-4;
  const ElementShape shape = element_shape(ElementType::tet4, sliver(lift));
  EXPECT_NEAR(shape.largest_angle, pi - 2.0 * std::atan(lift), 1e-10);
  EXPECT_LT(shape.smallest_angle, 3.0 * lift);
  EXPECT_GT(shape.smallest_angle, lift);
  EXPECT_GT(shape.aspect_ratio, 1.0 / lift);
  EXPECT_LT(shape.aspect_ratio, 4.0 / lift);
}

Mesh one(const Eigen::MatrixX3d& nodes, std::int64_t tag) {
  return {nodes, {tests::block_of(ElementType::tet4, {{0, 1, 2, 3}}, tag)}, {}, {}};
}

// Hard case 30: aspect ratio 1e4, dihedral angle 179.9 degrees: valid, but told.
TEST(ElementShape, WarnsOfASliverByNumber) {
  const std::vector<std::string> warnings = shape_warnings(one(sliver(2e-4), 42));
  ASSERT_EQ(warnings.size(), 3U);
  for (const std::string& warning : warnings) {
    EXPECT_EQ(warning.find("1 of 1 elements is a sliver"), 0U) << warning;
    EXPECT_NE(warning.find("element 42"), std::string::npos) << warning;
  }
  EXPECT_NE(warnings[0].find("aspect ratio above 100"), std::string::npos) << warnings[0];
  EXPECT_NE(warnings[2].find("with 179.9"), std::string::npos) << warnings[2];
}

TEST(ElementShape, NamesTheWorst) {
  Eigen::MatrixX3d nodes(7, 3);  // node 2 of the first is node 0 of the second
  nodes << sliver(2e-3), sliver(2e-4).bottomRows(3).rowwise() + Eigen::RowVector3d(2, 0, 0);
  const Mesh mesh(nodes, {tests::block_of(ElementType::tet4, {{0, 1, 2, 3}, {2, 4, 5, 6}}, 8)}, {},
                  {});
  const std::vector<std::string> warnings = shape_warnings(mesh);
  ASSERT_FALSE(warnings.empty());
  EXPECT_EQ(warnings[0].find("2 of 2 elements"), 0U) << warnings[0];
  EXPECT_NE(warnings[0].find("the worst is element 9"), std::string::npos) << warnings[0];
}

TEST(ElementShape, SaysNothingAboutGoodElements) {
  EXPECT_TRUE(shape_warnings(one(regular_tetrahedron(), 1)).empty());
}

}  // namespace
}  // namespace microslip::mesh::test_element_shape
