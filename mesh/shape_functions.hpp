/// @file
/// Shape functions and their derivatives on reference elements, in the node order of
/// element_type.hpp. Tetrahedra and triangles on the unit simplex, hexahedra on [−1, 1]³
/// (serendipity for 20 nodes), quadrilaterals on [−1, 1]², wedges on the unit triangle × [−1, 1]
/// (serendipity for 15 nodes), pyramids on {0 ≤ ζ ≤ 1, |ξ|, |η| ≤ 1 − ζ}: base [−1, 1]², apex (0,
/// 0, 1).
///
/// Shape functions of a pyramid that fit those of its neighbours on all faces are rational. With w
/// = 1 − ζ, a = ξ/w, b = η/w each is w times a polynomial g(a, b, w), and so
///
///   ∂N/∂ξ = ∂g/∂a,   ∂N/∂η = ∂g/∂b,   ∂N/∂ζ = a ∂g/∂a + b ∂g/∂b − g − w ∂g/∂w                  (1)
///
/// have nothing to divide by. At the apex itself, where a and b depend on the way there, (1) is
/// taken on the axis, a = b = 0.
///
/// Source of the pyramids: Bedrosian, Shape functions and integration formulas for
/// three-dimensional finite element analysis, Int. J. Numer. Methods Eng. 35 (1992) 95–108.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "mesh/element_type.hpp"

namespace microslip::mesh {

struct ElementShapes {
  Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most_element_nodes, 1> values;  ///< N_a, n
  Eigen::Matrix<double, Eigen::Dynamic, 3, 0, most_element_nodes, 3> gradients;  ///< ∂N_a/∂ξ, n × 3
};

struct FaceShapes {
  Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most_face_nodes, 1> values;     ///< N_a, n
  Eigen::Matrix<double, Eigen::Dynamic, 2, 0, most_face_nodes, 2> gradients;  ///< ∂N_a/∂ξ, n × 2
};

[[nodiscard]] ElementShapes shapes(ElementType type, const Eigen::Vector3d& xi);
[[nodiscard]] FaceShapes shapes(FaceType type, const Eigen::Vector2d& xi);

/// Reference coordinates of the nodes, n × 3.
[[nodiscard]] Eigen::MatrixX3d reference_nodes(ElementType type);

/// Local nodes of each face, seen from outside counter-clockwise: corners, then edges.
[[nodiscard]] std::span<const std::vector<int>> faces(ElementType type);
[[nodiscard]] FaceType face_type(ElementType type, std::size_t face);

}  // namespace microslip::mesh
