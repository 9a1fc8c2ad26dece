#include "mesh/elements/face_map.hpp"

#include <gtest/gtest.h>

#include "mesh/shape_functions.hpp"
#include "tests/mesh/given_mesh.hpp"

namespace microslip::mesh::test_face_map {
namespace {

using tests::block_of;
using tests::message_of;

/// Corners 0–3 of the reference tetrahedron and two points on either side of its face 1 2 3.
Eigen::MatrixX3d five_points() {
  Eigen::MatrixX3d nodes(6, 3);
  nodes << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1, 0.1, 0.1, 0.1;
  return nodes;
}

TEST(FaceMap, CountsTheElementsOfEachFace) {
  const std::vector<ElementBlock> elements{
      block_of(ElementType::tet4, {{0, 1, 2, 3}, {1, 2, 3, 4}}, 1)};
  const FaceMap map = map_faces(elements);
  EXPECT_EQ(map.size(), 7U);
  EXPECT_EQ(map.at(face_key({3, 1, 2}, 3)).count, 2);
  EXPECT_EQ(map.at(face_key({0, 1, 2}, 3)).count, 1);
  EXPECT_NO_THROW(check_faces(elements, map));
}

TEST(FaceMap, TellsTrianglesFromQuadrilaterals) {
  EXPECT_EQ(face_key({5, 2, 9, 0}, 3), (FaceKey{-1, 2, 5, 9}));
  EXPECT_EQ(face_key({5, 2, 9, 0}, 4), (FaceKey{0, 2, 5, 9}));
}

TEST(FaceMap, GivesTheNodesOfAFaceAsItsElementHasThem) {
  const std::vector<ElementBlock> elements{
      block_of(ElementType::tet10, {{0, 1, 2, 3, 4, 5, 6, 7, 8, 9}}, 1)};
  for (const auto& [key, owners] : map_faces(elements)) {
    const std::vector<Eigen::Index> nodes = face_nodes(elements, owners.uses[0]);
    ASSERT_EQ(nodes.size(), 6U);
    EXPECT_EQ(face_key({nodes[0], nodes[1], nodes[2], 0}, 3), key);
  }
}

TEST(FaceMap, RefusesElementsOnOneSideOfAFace) {
  const std::string message = message_of([] {
    Mesh(five_points().topRows(6), {block_of(ElementType::tet4, {{0, 1, 2, 3}, {5, 1, 2, 3}}, 11)},
         {}, {});
  });
  EXPECT_NE(message.find("1 face has both its elements on one side: elements 11, 12"),
            std::string::npos)
      << message;
}

TEST(FaceMap, RefusesAnElementThatIsThereTwice) {
  const std::string message = message_of([] {
    Mesh(reference_nodes(ElementType::hex8),
         {block_of(ElementType::hex8, {{0, 1, 2, 3, 4, 5, 6, 7}, {0, 1, 2, 3, 4, 5, 6, 7}}, 7)}, {},
         {});
  });
  EXPECT_NE(message.find("6 faces have both their elements on one side: elements 7, 8"),
            std::string::npos)
      << message;
}

TEST(FaceMap, RefusesFacesOfThreeElements) {
  const std::string message = message_of([] {
    Mesh(five_points(),
         {block_of(ElementType::tet4, {{0, 1, 2, 3}, {1, 2, 3, 4}, {5, 1, 2, 3}}, 21)}, {}, {});
  });
  EXPECT_NE(message.find("1 face has three or more elements: elements 21, 22, 23"),
            std::string::npos)
      << message;
}

TEST(FaceMap, RefusesNeighboursOfDifferentOrder) {
  Eigen::MatrixX3d nodes(11, 3);
  nodes << reference_nodes(ElementType::tet10), 1, 1, 1;
  const std::string message = message_of([&] {
    Mesh(nodes,
         {block_of(ElementType::tet10, {{0, 1, 2, 3, 4, 5, 6, 7, 8, 9}}, 1),
          block_of(ElementType::tet4, {{1, 2, 3, 10}}, 2)},
         {}, {});
  });
  EXPECT_NE(message.find("1 face has two elements that share its corners but not its edges"),
            std::string::npos)
      << message;
  EXPECT_NE(message.find("elements 1, 2"), std::string::npos) << message;
}

// A wedge has faces of both kinds, a pyramid on one of its quadrilaterals and a tetrahedron on a
// triangle.
TEST(FaceMap, JoinsElementsOfDifferentSolids) {
  Eigen::MatrixX3d nodes(8, 3);
  nodes << reference_nodes(ElementType::wedge6), -1, 0.5, 0, 0.3, 0.3, 2;
  const std::vector<ElementBlock> elements{block_of(ElementType::wedge6, {{0, 1, 2, 3, 4, 5}}, 1),
                                           block_of(ElementType::pyramid5, {{0, 3, 5, 2, 6}}, 2),
                                           block_of(ElementType::tet4, {{3, 4, 5, 7}}, 3)};
  const FaceMap map = map_faces(elements);
  EXPECT_EQ(map.size(), 5U + 5U + 4U - 2U);
  EXPECT_EQ(map.at(face_key({0, 2, 3, 5}, 4)).count, 2);
  EXPECT_EQ(map.at(face_key({3, 4, 5, 0}, 3)).count, 2);
  EXPECT_EQ(Mesh(nodes, elements, {}, {}).n_elements(), 3);
}

TEST(FaceMap, RefusesAQuadraticWedgeBesideALinearPyramid) {
  Eigen::MatrixX3d nodes(16, 3);
  nodes << reference_nodes(ElementType::wedge15), -1, 0.5, 0;
  const std::string message = message_of([&] {
    Mesh(nodes,
         {block_of(ElementType::wedge15, {{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14}}, 1),
          block_of(ElementType::pyramid5, {{0, 3, 5, 2, 15}}, 2)},
         {}, {});
  });
  EXPECT_NE(message.find("use one element order in the whole body"), std::string::npos) << message;
}

}  // namespace
}  // namespace microslip::mesh::test_face_map
