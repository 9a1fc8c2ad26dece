/// @file
/// Springs between a surface and the ground, spread over the points of a sampling.
#pragma once

#include <Eigen/SparseCore>

#include "fem/assembly/fe_system.hpp"
#include "mesh/surface.hpp"

namespace microslip::fem {

/// K += Σ_c w_c Σ_d k_cd (N_c e_d)ᵀ(N_c e_d); arguments as Structure::add_surface_springs.
/// @throws std::invalid_argument  sizes differ.
void add_springs(FeSystem& system, const mesh::Surface& surface,
                 const Eigen::SparseMatrix<double>& to_points, const Eigen::VectorXd& weights,
                 const Eigen::Matrix3d& frame, const Eigen::MatrixX3d& stiffness);

}  // namespace microslip::fem
