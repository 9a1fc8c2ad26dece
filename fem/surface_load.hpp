/// @file
/// Consistent nodal loads of tractions on a surface.
#pragma once

#include <Eigen/Core>

#include "mesh/surface.hpp"

namespace microslip::fem {

/// Loads of uniform unit tractions (1 Pa) along the rows of `frame`: ∫ N_a dA e_axis.
/// @param nodes  all mesh nodes [m].
/// @return 3 n_nodes × 3 [N]; each column sums to the area along its axis.
[[nodiscard]] Eigen::MatrixXd uniform_tractions(const Eigen::MatrixX3d& nodes,
                                                const mesh::Surface& surface,
                                                const Eigen::Matrix3d& frame);

}  // namespace microslip::fem
