/// @file
/// The lowest elastic modes, none missed: a Krylov method finds them, the inertia of an LDLᵀ
/// factorisation just above the last one counts them, and what is missing is searched beside what
/// was found.
///
///   number of λ < σ  =  number of negative pivots of K − σM        (Sylvester's law of inertia)
///
/// σ stands in the first gap at or above the last mode asked for, so that a cluster is never cut.
///
/// Source: Parlett, The Symmetric Eigenvalue Problem (1998), sections 1.6 and 3.3.
#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "fem/eigen/eigensolver.hpp"
#include "fem/petsc/handle.hpp"

namespace microslip::fem {

struct CountedPairs {
  EigenPairs pairs;  ///< elastic pairs, at least as many as asked
  /// Eigenvalues below `count_shift` by inertia, rigid-body modes included; −1: not counted.
  Eigen::Index n_counted = -1;
  Eigen::Index n_below = 0;  ///< of `pairs`, those below `count_shift`
  double count_shift = 0.0;  ///< σ [rad²/s²]
  double search_seconds = 0.0;
  double inertia_seconds = 0.0;
};

/// Whether modes are counted: that takes a factorisation, which an iterative solution does without.
/// Later: `count_shift` and `n_below` tell what a count must give.
enum class ModeCount : std::uint8_t { by_inertia, later, none };

/// K − shift M, same pattern.
[[nodiscard]] MatHandle shifted_stiffness(const FeSystem& system, double shift);

/// Eigenvalues below σ, by a factorisation of its own.
[[nodiscard]] Eigen::Index count_below(const FeSystem& system, double shift);

/// @param rigid  M-orthonormal rigid-body modes, rows of this rank × n_rigid.
/// @param n      elastic modes wanted, ≥ 0.
/// @throws EigenError  "eigen-missed-mode" if the count and the search do not agree in the end,
///         with both numbers.
[[nodiscard]] CountedPairs find_elastic_modes(const FeSystem& system, const LinearSolver& inverse,
                                              double shift, Eigen::Index n,
                                              const Eigen::MatrixXd& rigid,
                                              ModeCount counting = ModeCount::by_inertia);

}  // namespace microslip::fem
