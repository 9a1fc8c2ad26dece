#include "mesh/checks/mesh_overlap.hpp"

#include <gtest/gtest.h>

#include "mesh/shape_functions.hpp"
#include "tests/mesh/given_mesh.hpp"

namespace microslip::mesh::test_mesh_overlap {
namespace {

using tests::block_of;
using tests::message_of;

// Node 0 in common, the second tetrahedron around the diagonal of the first.
TEST(MeshOverlap, RefusesElementsThatOverlapWithoutACommonFace) {
  Eigen::MatrixX3d nodes(7, 3);
  nodes << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 2, 0.2, 0.2, 0.2, 2, 0.2, 0.2, 0.2, 2;
  const std::string message = message_of([&] {
    Mesh(nodes, {block_of(ElementType::tet4, {{0, 1, 2, 3}, {0, 4, 5, 6}}, 31)}, {}, {});
  });
  EXPECT_NE(message.find("inside other elements"), std::string::npos) << message;
  EXPECT_NE(message.find("31 in 32"), std::string::npos) << message;
  EXPECT_NE(message.find("the elements overlap"), std::string::npos) << message;
}

/// A cube beside two tetrahedra that split its face in two triangles.
Mesh quadrilateral_against_triangles() {
  Eigen::MatrixX3d nodes(9, 3);
  nodes << reference_nodes(ElementType::hex8), 3, 0, 0;
  return {nodes,
          {block_of(ElementType::hex8, {{0, 1, 2, 3, 4, 5, 6, 7}}, 1),
           block_of(ElementType::tet4, {{1, 2, 6, 8}, {1, 6, 5, 8}}, 2)},
          {},
          {}};
}

TEST(MeshOverlap, RefusesAQuadrilateralAgainstTwoTriangles) {
  const std::string message = message_of([] { quadrilateral_against_triangles(); });
  EXPECT_NE(message.find("3 outer faces lie on other elements without being joined"),
            std::string::npos)
      << message;
  EXPECT_NE(message.find("2 on 1, 3 on 1"), std::string::npos) << message;
  EXPECT_NE(message.find("the faces do not match"), std::string::npos) << message;
}

// One cube against two half as high: the nodes between them hang on the middle of its edges.
TEST(MeshOverlap, RefusesNodesThatHangOnAnEdge) {
  Eigen::MatrixX3d nodes(16, 3);
  nodes << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1,  // the cube
      1, 0, 0.5, 1, 1, 0.5,                                                         // hang
      2, 0, 0, 2, 1, 0, 2, 0, 0.5, 2, 1, 0.5, 2, 0, 1, 2, 1, 1;
  const std::string message = message_of([&] {
    Mesh(nodes,
         {block_of(
             ElementType::hex8,
             {{0, 1, 2, 3, 4, 5, 6, 7}, {1, 10, 11, 2, 8, 12, 13, 9}, {8, 12, 13, 9, 5, 14, 15, 6}},
             1)},
         {}, {});
  });
  EXPECT_NE(message.find("without being joined"), std::string::npos) << message;
  EXPECT_NE(message.find("2 on 1, 3 on 1"), std::string::npos) << message;
}

/// A base with two prongs, a gap [m] between them; a unit cube each.
Mesh prongs(double gap) {
  Eigen::MatrixX3d nodes(18, 3);
  const double x[4] = {0.0, 1.0, 1.0 + gap, 2.0 + gap};
  for (int i = 0; i < 4; ++i) {
    nodes.row(2 * i) << x[i], 0, 1;
    nodes.row(2 * i + 1) << x[i], 1, 1;
    nodes.row(8 + 2 * i) << x[i], 0, 2;
    nodes.row(9 + 2 * i) << x[i], 1, 2;
  }
  // The base joins the outer and inner edges of the prongs in one hexahedron below each and the
  // gap.
  Eigen::MatrixX3d all(24, 3);
  all.topRows(16) = nodes.topRows(16);
  for (int i = 0; i < 4; ++i) {
    all.row(16 + 2 * i) << x[i], 0, 0;
    all.row(17 + 2 * i) << x[i], 1, 0;
  }
  const auto hexahedron = [](Eigen::Index low, Eigen::Index high, Eigen::Index i) {
    return std::vector<Eigen::Index>{low + 2 * i,      low + 2 * i + 2, low + 2 * i + 3,
                                     low + 2 * i + 1,  high + 2 * i,    high + 2 * i + 2,
                                     high + 2 * i + 3, high + 2 * i + 1};
  };
  return {all,
          {block_of(ElementType::hex8,
                    {hexahedron(16, 0, 0), hexahedron(16, 0, 1), hexahedron(16, 0, 2),
                     hexahedron(0, 8, 0), hexahedron(0, 8, 2)},
                    1)},
          {},
          {}};
}

TEST(MeshOverlap, AllowsANarrowGap) { EXPECT_NO_THROW(prongs(1e-3)); }

// Prongs as wide as the base allows, then bent into each other at the top.
TEST(MeshOverlap, RefusesPartsOfTheBodyThatCross) {
  const Mesh good = prongs(0.1);
  Eigen::MatrixX3d nodes = good.nodes();
  nodes(10, 0) += 0.3, nodes(11, 0) += 0.3;  // inner top edge of the left prong
  nodes(8, 0) += 0.3, nodes(9, 0) += 0.3;
  const std::string message = message_of([&] { Mesh(nodes, good.elements(), {}, {}); });
  EXPECT_NE(message.find("the elements overlap"), std::string::npos) << message;
  EXPECT_NE(message.find("4 in 5, 5 in 4"), std::string::npos) << message;
}

}  // namespace
}  // namespace microslip::mesh::test_mesh_overlap
