/// @file
/// Stiffness and mass of another code on the nodes of a mesh.
#pragma once

#include <Eigen/SparseCore>

namespace microslip::fem {

/// Both symmetric, (3 n_nodes)², x y z per mesh node, lower and upper half stored. A displacement
/// whose diagonal of K and M is 0 is held.
struct GivenMatrices {
  Eigen::SparseMatrix<double, Eigen::RowMajor> stiffness;  ///< K [N/m]
  Eigen::SparseMatrix<double, Eigen::RowMajor> mass;       ///< M [kg]
};

}  // namespace microslip::fem
