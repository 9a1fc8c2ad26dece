/// @file
/// Lowest eigenpairs of Kφ = λMφ by shift-invert Krylov–Schur (SLEPc) with a given solver of K −
/// shift M.
///
/// Source: Stewart, SIAM J. Matrix Anal. Appl. 23 (2001) 601–614; Hernandez, Roman & Vidal, ACM
/// Trans. Math. Softw. 31 (2005) 351–362.
#pragma once

#include <Eigen/Core>

#include "fem/assembly/fe_system.hpp"
#include "fem/petsc/linear_solver.hpp"

namespace microslip::fem {

struct EigenPairs {
  Eigen::VectorXd values;   ///< λ = ω² [rad²/s²], ascending
  Eigen::MatrixXd vectors;  ///< φ, rows of this rank × n, ΦᵀMΦ = I
};

/// What one Krylov search gives. Its vectors still carry a little of high modes, which λ does not
/// feel but Kφ does: refine() takes it out, all columns in one block.
struct FoundPairs {
  EigenPairs pairs;        ///< converged
  Eigen::VectorXd beyond;  ///< lower estimates of the next eigenvalues, not converged [rad²/s²]
};

/// ‖(K − shift M)⁻¹Mφ − θφ‖ ≤ 1e-10 θ, θ = 1/(λ − shift), of every pair.
///
/// @param inverse    solves with K − shift M.
/// @param shift      [rad²/s²], below every wanted eigenvalue.
/// @param n_wanted   ≥ 1; more are returned when more converged, fewer when the rest of the space
///                   is smaller.
/// @param deflation  M-orthonormal columns to search beside (known pairs), rows of this rank × k.
/// @throws EigenError  fewer converged: both numbers and the tolerance.
[[nodiscard]] FoundPairs lowest_pairs(const FeSystem& system, const LinearSolver& inverse,
                                      double shift, Eigen::Index n_wanted,
                                      const Eigen::MatrixXd& deflation);

/// One step of subspace iteration and Rayleigh–Ritz over all columns: orders pairs that were found
/// in several runs, and turns what is left of foreign modes far down.
[[nodiscard]] EigenPairs refine(const FeSystem& system, const LinearSolver& inverse,
                                const Eigen::MatrixXd& vectors);

/// ‖Kφ − λMφ‖ / ‖Kφ‖ of each pair.
[[nodiscard]] Eigen::VectorXd relative_residuals(const FeSystem& system, const EigenPairs& pairs);

}  // namespace microslip::fem
