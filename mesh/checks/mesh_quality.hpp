/// @file
/// What makes a mesh unusable, found when it is made: inverted or flat elements, nodes that
/// coincide but are not joined, parts that do not hang together.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "mesh/element_block.hpp"

namespace microslip::mesh {

/// Bounds of the Jacobian determinant over a whole element [m³ per unit of reference volume].
struct JacobianRange {
  double least =
      0.0;  ///< smallest value; for tet10 a lower bound (Bernstein coefficients), sharp to
            ///< 1e-3 of the spread, for others the smallest of 11 samples per direction
  double largest = 0.0;  ///< largest value sampled
};

/// @param nodes  coordinates of the nodes of one element, project order, n × 3 [m].
[[nodiscard]] JacobianRange jacobian_range(ElementType type, const Eigen::MatrixX3d& nodes);

/// ∫dV of one element [m³], as ⅓ ∮ x·n dA over its faces.
[[nodiscard]] double element_volume(ElementType type, const Eigen::MatrixX3d& nodes);

/// @throws MeshError  the first kinds of finding, with element numbers or coordinates.
void check_elements(const Eigen::MatrixX3d& nodes, const std::vector<ElementBlock>& elements);
void check_coincident_nodes(const Eigen::MatrixX3d& nodes);
void check_connected(Eigen::Index n_nodes, const std::vector<ElementBlock>& elements,
                     const Eigen::MatrixX3d& nodes);

}  // namespace microslip::mesh
