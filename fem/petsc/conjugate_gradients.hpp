/// @file
/// Conjugate gradients preconditioned by multigrid: where a factorisation does not fit into memory.
///
/// Quadratic elements: two levels, all nodes and corners alone (fem/assembly/corner_interpolation),
///
///   A_c = PᵀAP,                                                                                (1)
///
/// factorised: a sixth to an eighth of the unknowns of tetrahedra. All nodes are smoothed by two
/// Chebyshev steps over the diagonal.
///
/// Linear elements: algebraic multigrid (PETSc's GAMG, smoothed aggregation). The rigid-body
/// motions are the near null space that coarse levels must represent; without them slender bodies
/// take hundreds of steps.
///
/// Source: Vaněk, Mandel & Brezina, Computing 56 (1996) 179–196; Adams, Bayraktar, Keaveny &
/// Papadopoulos, Proc. SC2004.
#pragma once

#include <memory>

#include <Eigen/Core>

#include "fem/petsc/factorisation.hpp"
#include "fem/petsc/guarded_solver.hpp"
#include "fem/petsc/linear_solver.hpp"

namespace microslip::fem {

class ConjugateGradients : public LinearSolver {
 public:
  /// Sets the levels up. The matrix may change afterwards without effect.
  /// @param matrix  symmetric positive definite, blocks of three, upper half stored.
  /// @param nodes   places of the nodes of this rank, in the order of its rows [m].
  /// @param from_corners  P; null: levels are found by aggregation.
  /// @throws MemoryError  A_c does not fit; PetscError  another failure of its factorisation.
  ConjugateGradients(Mat matrix, const Eigen::MatrixX3d& nodes, Mat from_corners = nullptr);

  /// ‖b − A x‖ ≤ 1e-10 ‖b‖ of each column.
  /// @throws EigenError  "iterative: …" after 2000 steps, with the residual that was reached.
  [[nodiscard]] Eigen::MatrixXd solve(const Eigen::MatrixXd& rhs) const override;
  void apply(Vec rhs, Vec solution) const override;
  [[nodiscard]] double ordering_seconds() const override { return 0.0; }
  [[nodiscard]] double factor_seconds() const override { return setup_seconds_; }

 private:
  void set_two_levels(Mat matrix, Mat from_corners);
  void set_aggregates(Mat matrix, const Eigen::MatrixX3d& nodes);

  MatHandle matrix_;
  MatHandle corner_matrix_;
  std::unique_ptr<Factorisation> corner_solver_;
  std::unique_ptr<GuardedSolver> corners_;  // of which the levels know the address
  KspHandle solver_;
  double setup_seconds_ = 0.0;
};

}  // namespace microslip::fem
