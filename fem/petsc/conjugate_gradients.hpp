/// @file
/// Conjugate gradients preconditioned by algebraic multigrid (PETSc's GAMG, smoothed aggregation):
/// where a factorisation does not fit into memory. The rigid-body motions are the near null space
/// that coarse levels must represent; without them slender bodies take hundreds of steps.
///
/// Source: Vaněk, Mandel & Brezina, Computing 56 (1996) 179–196; Adams, Bayraktar, Keaveny &
/// Papadopoulos, Proc. SC2004.
#pragma once

#include <Eigen/Core>

#include "fem/petsc/linear_solver.hpp"

namespace microslip::fem {

class ConjugateGradients : public LinearSolver {
 public:
  /// Sets the levels up. The matrix may change afterwards without effect.
  /// @param matrix  symmetric positive definite, blocks of three, upper half stored.
  /// @param nodes   places of the nodes of this rank, in the order of its rows [m].
  ConjugateGradients(Mat matrix, const Eigen::MatrixX3d& nodes);

  /// ‖b − A x‖ ≤ 1e-10 ‖b‖ of each column.
  /// @throws EigenError  "iterative: …" after 2000 steps, with the residual that was reached.
  [[nodiscard]] Eigen::MatrixXd solve(const Eigen::MatrixXd& rhs) const override;
  void apply(Vec rhs, Vec solution) const override;
  [[nodiscard]] double ordering_seconds() const override { return 0.0; }
  [[nodiscard]] double factor_seconds() const override { return setup_seconds_; }

 private:
  MatHandle matrix_;
  KspHandle solver_;
  double setup_seconds_ = 0.0;
};

}  // namespace microslip::fem
