/// @file
/// One element cut into smaller ones of the same order, once along each edge: 8 of a tetrahedron,
/// a hexahedron or a wedge; 6 pyramids and 4 tetrahedra of a pyramid. Faces are cut into 4 of their
/// kind, so that neighbours of any solid fit.
///
/// Within a tetrahedron an octahedron is left, cut along one of its three diagonals: the shortest
/// keeps elements well shaped.
///
/// Source of the tetrahedra: Bey, Tetrahedral grid refinement, Computing 55 (1995) 355–378.
#pragma once

#include <utility>
#include <vector>

#include <Eigen/Core>

#include "mesh/element_type.hpp"

namespace microslip::mesh {

/// How much of each corner a point is: (corner, share) of all that have one; shares in parts of
/// `whole_corner`, by the shape functions of the element with corners only. On a face or an edge
/// they are of its corners alone, the same from either side.
using CornerShares = std::vector<std::pair<int, int>>;
inline constexpr int whole_corner = 4096;

struct ElementSplit {
  struct Child {
    ElementType type;
    std::vector<int> points;  ///< its nodes, project order
  };
  Eigen::MatrixX3d points;           ///< reference coordinates: first the nodes of the element
  std::vector<CornerShares> shares;  ///< of each point
  Eigen::MatrixXd shapes;            ///< of the element at the points, n_points × n_nodes
  std::vector<Child> children;
};

/// @param diagonal  of the octahedron in a tetrahedron: from the middle of edge 01, 02 or 03 to
///                  that of the opposite one: 0, 1 or 2. Else 0.
[[nodiscard]] ElementSplit element_split(ElementType type, int diagonal);

/// One element that is the given one with nodes in the middle of its edges.
[[nodiscard]] ElementSplit midside_split(ElementType type);

/// The same of a face, as far as its points go.
struct FaceSplit {
  std::vector<CornerShares> shares;        ///< of each point
  std::vector<std::vector<int>> children;  ///< corners of each, points
};

/// @note Points that no element has are among those of a quadratic face with four corners.
[[nodiscard]] FaceSplit face_split(FaceType type);

}  // namespace microslip::mesh
