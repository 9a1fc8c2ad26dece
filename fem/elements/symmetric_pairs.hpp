/// @file
/// Eigenpairs of small symmetric matrices, compiled once: Eigen's solver costs every file that
/// makes one of its own ten seconds.
#pragma once

#include <Eigen/Core>

namespace microslip::fem {

/// A φ = λ φ, ΦᵀΦ = I.
struct SymmetricPairs {
  Eigen::VectorXd values;   ///< λ, ascending
  Eigen::MatrixXd vectors;  ///< Φ, columns
};

/// All pairs; the lower triangle is read. Numbers that are not finite go through, as in Eigen.
[[nodiscard]] SymmetricPairs symmetric_pairs(const Eigen::MatrixXd& A);

/// Values λ of K φ = λ M φ, ascending.
/// @param M  positive definite.
[[nodiscard]] Eigen::VectorXd pencil_eigenvalues(const Eigen::MatrixXd& K,
                                                 const Eigen::MatrixXd& M);

}  // namespace microslip::fem
