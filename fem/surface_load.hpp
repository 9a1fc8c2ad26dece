/// @file
/// Nodal forces of a traction on a surface.
#pragma once

#include <Eigen/Core>

#include "mesh/surface.hpp"

namespace microslip::fem {

/// a_i = ∫ N_i dA of each node of the surface [m²], in the order of surface.nodes; the sum is the area.
/// Nodal areas of curved or second-order faces may be zero or negative at corners.
[[nodiscard]] Eigen::VectorXd nodal_areas(const Eigen::MatrixX3d& nodes, const mesh::Surface& surface);

/// Forces of a unit uniform traction along each row of `frame` [N per Pa], 3 n_nodes × 3.
[[nodiscard]] Eigen::MatrixXd traction_loads(const Eigen::MatrixX3d& nodes,
                                             const mesh::Surface& surface,
                                             const Eigen::Matrix3d& frame);

}  // namespace microslip::fem
