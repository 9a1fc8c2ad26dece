/// @file
/// Sparse direct factorisation of a symmetric PETSc matrix by MUMPS.
#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "fem/machine_memory.hpp"
#include "fem/petsc/handle.hpp"
#include "fem/petsc/linear_solver.hpp"

namespace microslip::fem {

enum class FactorKind : std::uint8_t {
  positive_definite,  ///< LDLᵀ without pivoting: fastest
  indefinite,         ///< LDLᵀ with pivoting; counts the signs of the pivots
  inertia_only,       ///< the same, but the factors are not kept: no solves
};

/// Number of negative and vanishing eigenvalues (Sylvester's law of inertia).
struct Inertia {
  Eigen::Index negative = 0;
  Eigen::Index zero = 0;
};

class Factorisation : public LinearSolver {
 public:
  /// Orders and factorises. The matrix may change afterwards without effect.
  /// @param memory_mb  what may be used [MB]; compared with what MUMPS expects to need after
  ///                   ordering.
  /// @throws MemoryError  it does not fit; PetscError  another failure of MUMPS, with its code.
  Factorisation(Mat matrix, FactorKind kind, double memory_mb = available_memory_mb());

  /// Solves A X = B for all columns in one go. @param rhs  rows of this rank × m.
  [[nodiscard]] Eigen::MatrixXd solve(const Eigen::MatrixXd& rhs) const override;
  void apply(Vec rhs, Vec solution) const override;
  /// Of any but a `positive_definite` factorisation.
  [[nodiscard]] Inertia inertia() const;
  [[nodiscard]] double ordering_seconds() const override { return ordering_seconds_; }
  [[nodiscard]] double factor_seconds() const override { return factor_seconds_; }

 private:
  MatHandle factor_;
  double ordering_seconds_ = 0.0;
  double factor_seconds_ = 0.0;
};

}  // namespace microslip::fem
