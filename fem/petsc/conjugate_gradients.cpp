#include "fem/petsc/conjugate_gradients.hpp"

#include <array>
#include <chrono>
#include <string>
#include <utility>

#include <petscksp.h>

#include "fem/elements/number_text.hpp"
#include "fem/petsc/columns.hpp"
#include "fem/petsc/petsc_check.hpp"
#include "fem/petsc_error.hpp"

namespace microslip::fem {
namespace {

// Residuals of modes are those of the solutions: two decades below what is asked of a mode (1e-8).
constexpr double tolerance = 1e-10;
constexpr PetscInt most_steps = 2000;
constexpr const char* prefix = "microslip_iterative_";

/// What only the data base of options can say of the levels of GAMG.
void set_options() {
  constexpr std::array<std::pair<const char*, const char*>, 5> options{{
      {"mg_levels_ksp_type", "chebyshev"},
      {"mg_levels_ksp_max_it", "1"},  // more take fewer steps and more time
      // Aggregates of a node or two have no part in some rotations: zeros on the diagonals of
      // coarse levels, which other smoothers divide by.
      {"mg_levels_pc_type", "jacobi"},
      {"pc_gamg_threshold", "0.01"},  // what couples less does not join an aggregate
      {"pc_gamg_coarse_eq_limit", "1000"},
  }};
  for (const auto& [name, value] : options) {
    check(PetscOptionsSetValue(nullptr, (std::string("-") + prefix + name).c_str(), value));
  }
}

/// Largest eigenvalue of the matrix under a smoother, from below:
/// ten steps of Lanczos from random numbers.
double largest_eigenvalue(Mat matrix, PCType smoother) {
  KspHandle steps;
  PC preconditioner = nullptr;
  VecHandle random;
  VecHandle found;
  PetscReal largest = 0.0;
  PetscReal smallest = 0.0;
  check(MatCreateVecs(matrix, random.out(), found.out()));
  check(VecSetRandom(random.get(), nullptr));
  check(KSPCreate(PETSC_COMM_WORLD, steps.out()));
  check(KSPSetType(steps.get(), KSPCG));
  check(KSPSetOperators(steps.get(), matrix, matrix));
  check(KSPGetPC(steps.get(), &preconditioner));
  check(PCSetType(preconditioner, smoother));
  check(KSPSetTolerances(steps.get(), PETSC_SMALL, PETSC_SMALL, PETSC_DEFAULT, 10));
  check(KSPSetComputeSingularValues(steps.get(), PETSC_TRUE));
  check(KSPSolve(steps.get(), random.get(), found.get()));
  check(KSPComputeExtremeSingularValues(steps.get(), &largest, &smallest));
  return largest;
}

/// On the finest level, which the number of steps depends on most, symmetric Gauss–Seidel: half the
/// steps of Jacobi. On several ranks it sees the nodes of its own alone,
/// and the largest eigenvalue is above 1.
void smooth_finest_level(PC levels, Mat matrix) {
  PetscInt n = 0;
  KSP smoother = nullptr;
  PC preconditioner = nullptr;
  check(PCMGGetLevels(levels, &n));
  if (n < 2) return;
  const double largest = 1.1 * largest_eigenvalue(matrix, PCSOR);
  check(PCMGGetSmoother(levels, n - 1, &smoother));
  check(KSPChebyshevSetEigenvalues(smoother, largest, 0.1 * largest));
  check(KSPGetPC(smoother, &preconditioner));
  check(PCSetType(preconditioner, PCSOR));
}

/// Of two levels.
void smooth_all_nodes(PC levels, Mat matrix) {
  constexpr PetscInt steps = 2;
  KSP smoother = nullptr;
  PC preconditioner = nullptr;
  const double largest = 1.1 * largest_eigenvalue(matrix, PCJACOBI);
  check(PCMGGetSmoother(levels, 1, &smoother));
  check(KSPSetType(smoother, KSPCHEBYSHEV));
  check(KSPChebyshevSetEigenvalues(smoother, largest, 0.1 * largest));
  check(KSPSetTolerances(smoother, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT, steps));
  check(KSPGetPC(smoother, &preconditioner));
  check(PCSetType(preconditioner, PCJACOBI));
}

/// Equation (1). The product takes both halves of the matrix; they are given up again.
MatHandle between_corners(Mat matrix, Mat from_corners) {
  MatHandle both_halves;
  MatHandle result;
  check(MatConvert(matrix, MATAIJ, MAT_INITIAL_MATRIX, both_halves.out()));
  check(MatPtAP(both_halves.get(), from_corners, MAT_INITIAL_MATRIX, PETSC_DEFAULT, result.out()));
  check(MatProductClear(result.get()));
  return result;
}

void set_rigid_motions(Mat matrix, const Eigen::MatrixX3d& nodes) {
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
  RowMajor places = nodes;
  VecHandle coordinates;
  check(VecCreateMPIWithArray(PETSC_COMM_WORLD, 3, static_cast<PetscInt>(places.size()),
                              PETSC_DECIDE, places.data(), coordinates.out()));
  MatNullSpace motions = nullptr;
  check(MatNullSpaceCreateRigidBody(coordinates.get(), &motions));
  const auto code = MatSetNearNullSpace(matrix, motions);
  check(MatNullSpaceDestroy(&motions));
  check(code);
}

}  // namespace

ConjugateGradients::ConjugateGradients(Mat matrix, const Eigen::MatrixX3d& nodes,
                                       Mat from_corners) {
  const auto start = std::chrono::steady_clock::now();
  check(KSPCreate(PETSC_COMM_WORLD, solver_.out()));
  check(KSPSetOptionsPrefix(solver_.get(), prefix));
  check(KSPSetType(solver_.get(), KSPCG));
  check(KSPSetNormType(solver_.get(), KSP_NORM_UNPRECONDITIONED));
  check(KSPSetTolerances(solver_.get(), tolerance, PETSC_DEFAULT, PETSC_DEFAULT, most_steps));
  if (from_corners != nullptr) {
    set_two_levels(matrix, from_corners);
  } else {
    set_aggregates(matrix, nodes);
  }
  setup_seconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Products take the half of the matrix that is stored: 1.6 times as fast as with both. A load of
/// the default blade with 31 395 unknowns takes 49 steps.
void ConjugateGradients::set_two_levels(Mat matrix, Mat from_corners) {
  check(MatDuplicate(matrix, MAT_COPY_VALUES, matrix_.out()));
  check(MatSetOption(matrix_.get(), MAT_SPD, PETSC_TRUE));
  check(KSPSetOperators(solver_.get(), matrix_.get(), matrix_.get()));
  corner_matrix_ = between_corners(matrix, from_corners);
  corner_solver_ =
      std::make_unique<Factorisation>(corner_matrix_.get(), FactorKind::positive_definite);
  corners_ = std::make_unique<GuardedSolver>(*corner_solver_);
  PC levels = nullptr;
  KSP corners = nullptr;
  PC preconditioner = nullptr;
  check(KSPGetPC(solver_.get(), &levels));
  check(PCSetType(levels, PCMG));
  check(PCMGSetLevels(levels, 2, nullptr));
  check(PCMGSetGalerkin(levels, PC_MG_GALERKIN_NONE));
  check(PCMGSetInterpolation(levels, 1, from_corners));
  check(PCMGGetCoarseSolve(levels, &corners));
  check(KSPSetOperators(corners, corner_matrix_.get(), corner_matrix_.get()));
  check(KSPSetType(corners, KSPPREONLY));
  check(KSPGetPC(corners, &preconditioner));
  use_solver(preconditioner, *corners_);
  smooth_all_nodes(levels, matrix_.get());
  check(KSPSetUp(solver_.get()));
}

void ConjugateGradients::set_aggregates(Mat matrix, const Eigen::MatrixX3d& nodes) {
  check(MatConvert(matrix, MATAIJ, MAT_INITIAL_MATRIX, matrix_.out()));  // GAMG takes no half
  check(MatSetBlockSize(matrix_.get(), 3));
  check(MatSetOption(matrix_.get(), MAT_SPD, PETSC_TRUE));
  check(KSPSetOperators(solver_.get(), matrix_.get(), matrix_.get()));
  set_rigid_motions(matrix_.get(), nodes);
  set_options();
  PC levels = nullptr;
  check(KSPGetPC(solver_.get(), &levels));
  check(PCSetType(levels, PCGAMG));
  check(PCGAMGSetType(levels, PCGAMGAGG));
  check(KSPSetFromOptions(solver_.get()));
  check(KSPSetUp(solver_.get()));
  smooth_finest_level(levels, matrix_.get());
}

void ConjugateGradients::apply(Vec rhs, Vec solution) const {
  const PetscErrorCode solved = KSPSolve(solver_.get(), rhs, solution);
  if (corners_) corners_->rethrow();
  check(solved);
  KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
  check(KSPGetConvergedReason(solver_.get(), &reason));
  if (reason > 0) return;
  PetscReal residual = 0.0;
  PetscReal size = 0.0;
  check(KSPGetResidualNorm(solver_.get(), &residual));
  check(VecNorm(rhs, NORM_2, &size));
  throw EigenError(
      "iterative: conjugate gradients stop with a residual of " + number_text(residual / size) +
      " of the load (reason " + std::to_string(static_cast<int>(reason)) +
      " of PETSc); badly shaped elements do that, or a body that is hardly held: solve "
      "directly");
}

Eigen::MatrixXd ConjugateGradients::solve(const Eigen::MatrixXd& rhs) const {
  Eigen::MatrixXd solution(rhs.rows(), rhs.cols());
  Eigen::VectorXd load(rhs.rows());
  for (Eigen::Index j = 0; j < rhs.cols(); ++j) {
    load = rhs.col(j);
    const VecHandle b = view_column(load);
    const VecHandle x = view_column(solution.col(j));
    apply(b.get(), x.get());
  }
  return solution;
}

}  // namespace microslip::fem
