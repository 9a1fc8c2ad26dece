/// @file
/// Lowest eigenpairs of Kφ = λMφ by shift-invert Krylov–Schur (SLEPc) on a factorisation of our own.
#pragma once

#include <Eigen/Core>

#include "fem/factorisation.hpp"
#include "fem/fe_system.hpp"

namespace microslip::fem {

/// Converged pairs in ascending order, at least as many as asked for when the solver found them.
struct EigenPairs {
  Eigen::VectorXd values;    ///< λ [rad²/s²]
  Eigen::MatrixXd vectors;   ///< φᵀMφ = 1, 3 n_free × n, complete on every rank
  Eigen::VectorXd residual;  ///< ‖Kφ − λMφ‖ / max(‖Kφ‖, |σ|‖Mφ‖)
};

/// @param inverse  of K − shift · M.
/// @param n_pairs  number asked for, ≥ 1.
/// @param n_basis  size of the Krylov basis; 0: chosen.
[[nodiscard]] EigenPairs lowest_pairs(const FeSystem& system, const Factorisation& inverse,
                                      double shift, Eigen::Index n_pairs, Eigen::Index n_basis = 0);

}  // namespace microslip::fem
