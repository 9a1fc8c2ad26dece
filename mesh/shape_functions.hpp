/// @file
/// Shape functions and their derivatives on reference elements, in the node order of element_type.hpp.
/// Tetrahedra and triangles on the unit simplex, hexahedra on [−1, 1]³ (serendipity for 20 nodes),
/// quadrilaterals on [−1, 1]².
#pragma once

#include <array>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "mesh/element_type.hpp"

namespace microslip::mesh {

struct ElementShapes {
  Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 20, 1> values;     ///< N_a, n
  Eigen::Matrix<double, Eigen::Dynamic, 3, 0, 20, 3> gradients;  ///< ∂N_a/∂ξ, n × 3
};

struct FaceShapes {
  Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 8, 1> values;     ///< N_a, n
  Eigen::Matrix<double, Eigen::Dynamic, 2, 0, 8, 2> gradients;  ///< ∂N_a/∂ξ, n × 2
};

[[nodiscard]] ElementShapes shapes(ElementType type, const Eigen::Vector3d& xi);
[[nodiscard]] FaceShapes shapes(FaceType type, const Eigen::Vector2d& xi);

/// Reference coordinates of the nodes, n × 3.
[[nodiscard]] Eigen::MatrixX3d reference_nodes(ElementType type);

/// Local nodes of each face, seen from outside counter-clockwise: corners, then edges.
[[nodiscard]] std::span<const std::vector<int>> faces(ElementType type);
[[nodiscard]] FaceType face_type(ElementType type);
[[nodiscard]] int n_corners(ElementType type);
[[nodiscard]] int n_corners(FaceType type);

}  // namespace microslip::mesh
