/// @file
/// Solves A X = B for one symmetric positive definite A, whichever way: a factorisation,
/// or conjugate gradients.
#pragma once

#include <Eigen/Core>

#include "fem/petsc/handle.hpp"

namespace microslip::fem {

class LinearSolver {
 public:
  virtual ~LinearSolver() = default;
  LinearSolver() = default;
  LinearSolver(const LinearSolver&) = delete;
  LinearSolver& operator=(const LinearSolver&) = delete;
  LinearSolver(LinearSolver&&) = default;
  LinearSolver& operator=(LinearSolver&&) = default;

  /// All columns. @param rhs  rows of this rank × m. Collective.
  [[nodiscard]] virtual Eigen::MatrixXd solve(const Eigen::MatrixXd& rhs) const = 0;
  /// One vector, for the solvers of the libraries.
  virtual void apply(Vec rhs, Vec solution) const = 0;
  [[nodiscard]] virtual double ordering_seconds() const = 0;
  /// Of all that is done before the first solution, ordering apart.
  [[nodiscard]] virtual double factor_seconds() const = 0;
};

}  // namespace microslip::fem
