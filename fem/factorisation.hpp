/// @file
/// Direct factorisation of K − σM by MUMPS: one for the eigensolver and all static solves, another for
/// counting eigenvalues.
#pragma once

#include <Eigen/Core>
#include <petscmat.h>

#include "fem/fe_system.hpp"

namespace microslip::fem {

class Factorisation {
 public:
  enum class Kind {
    positive_definite,  ///< Cholesky
    indefinite,         ///< LDLᵀ: has an inertia
  };

  /// K − shift · M.
  /// @throws EigenError      the factorisation broke down (matrix singular, or not positive).
  /// @throws std::bad_alloc  out of memory.
  Factorisation(const FeSystem& system, double shift, Kind kind);

  /// x = (K − σM)⁻¹ b.
  void solve(Vec b, Vec x) const;
  /// Several right-hand sides at a time. @param right  3 n_free × m, complete on every rank.
  [[nodiscard]] Eigen::MatrixXd solve(const Eigen::MatrixXd& right) const;
  /// Negative pivots: eigenvalues of Kφ = λMφ below the shift. Kind::indefinite only.
  [[nodiscard]] PetscInt n_below_shift() const;

  [[nodiscard]] double ordering_seconds() const { return ordering_seconds_; }
  [[nodiscard]] double factor_seconds() const { return factor_seconds_; }

 private:
  MatHandle matrix_;
  MatHandle factor_;
  double ordering_seconds_ = 0.0;
  double factor_seconds_ = 0.0;
};

}  // namespace microslip::fem
