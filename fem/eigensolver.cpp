#include "fem/eigensolver.hpp"

#include <algorithm>
#include <string>

#include <Eigen/Eigenvalues>

#include "fem/columns.hpp"
#include "fem/petsc_error.hpp"

namespace microslip::fem {
namespace {

// Of θ = 1/(λ − shift), relative: after refine() what is left is the rounding of φ itself.
constexpr double tolerance = 1e-9;

PetscErrorCode apply_factor(PC preconditioner, Vec rhs, Vec solution) {
  void* factor = nullptr;
  const PetscErrorCode code = PCShellGetContext(preconditioner, &factor);
  return code != 0 ? code : MatSolve(static_cast<Mat>(factor), rhs, solution);
}

void use_factorisation(EPS eps, const Factorisation& inverse, double shift) {
  ST transform = nullptr;
  KSP solver = nullptr;
  PC preconditioner = nullptr;
  check(EPSGetST(eps, &transform));
  check(STSetType(transform, STSINVERT));
  check(STSetMatMode(transform, ST_MATMODE_SHELL));  // K − shift M is factorised already
  check(EPSSetTarget(eps, shift));
  check(STGetKSP(transform, &solver));
  check(KSPSetType(solver, KSPPREONLY));
  check(KSPGetPC(solver, &preconditioner));
  check(PCSetType(preconditioner, PCSHELL));
  check(PCShellSetContext(preconditioner, inverse.get()));
  check(PCShellSetApply(preconditioner, apply_factor));
}

void set_deflation(EPS eps, Eigen::MatrixXd& columns) {
  if (columns.cols() == 0) return;
  std::vector<VecHandle> owners;
  std::vector<Vec> vectors;
  for (Eigen::Index j = 0; j < columns.cols(); ++j) {
    owners.push_back(view_column(columns.col(j)));
    vectors.push_back(owners.back().get());
  }
  check(EPSSetDeflationSpace(eps, static_cast<PetscInt>(vectors.size()), vectors.data()));
}

EigenPairs collect(EPS eps, Eigen::Index n_local) {
  PetscInt n = 0;
  check(EPSGetConverged(eps, &n));
  EigenPairs pairs{Eigen::VectorXd(n), Eigen::MatrixXd(n_local, n)};
  for (PetscInt k = 0; k < n; ++k) {
    const VecHandle vector = view_column(pairs.vectors.col(k));
    check(EPSGetEigenpair(eps, k, &pairs.values[k], nullptr, vector.get(), nullptr));
  }
  return pairs;
}

}  // namespace

EigenPairs lowest_pairs(const FeSystem& system, const Factorisation& inverse, double shift,
                        Eigen::Index n_wanted, const Eigen::MatrixXd& deflation) {
  const Eigen::Index space = 3 * system.dofs.n_free_nodes() - deflation.cols();
  const auto n = static_cast<PetscInt>(std::min(n_wanted, space));
  // Room for ten modes to converge without a restart: 33 solves instead of 37 with SLEPc's n + 15.
  const auto subspace = static_cast<PetscInt>(std::min<Eigen::Index>(std::max(2 * n, n + 20), space));
  Eigen::MatrixXd known = deflation;
  EpsHandle eps;
  check(EPSCreate(PETSC_COMM_WORLD, eps.out()));
  check(EPSSetOperators(eps.get(), system.stiffness.get(), system.mass_matrix.get()));
  check(EPSSetProblemType(eps.get(), EPS_GHEP));
  check(EPSSetType(eps.get(), EPSKRYLOVSCHUR));
  check(EPSSetWhichEigenpairs(eps.get(), EPS_TARGET_MAGNITUDE));
  use_factorisation(eps.get(), inverse, shift);
  check(EPSSetDimensions(eps.get(), n, subspace, PETSC_DEFAULT));
  check(EPSSetTolerances(eps.get(), tolerance, 300));
  set_deflation(eps.get(), known);
  check(EPSSolve(eps.get()));
  EigenPairs pairs = collect(eps.get(), system.dofs.n_local_dofs());
  if (pairs.values.size() < n) {
    throw EigenError("eigen-not-converged: " + std::to_string(n) + " modes requested, " +
                     std::to_string(pairs.values.size()) + " converged at tolerance 1e-9");
  }
  return pairs;
}

EigenPairs refine(const FeSystem& system, const Factorisation& inverse, const Eigen::MatrixXd& vectors) {
  const Mat M = system.mass_matrix.get();
  const Eigen::MatrixXd X = mass_orthonormal(M, inverse.solve(multiply(M, vectors)));
  const Eigen::MatrixXd projected = inner_products(X, multiply(system.stiffness.get(), X));
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> ritz(0.5 * (projected + projected.transpose()));
  return {ritz.eigenvalues(), X * ritz.eigenvectors()};
}

Eigen::VectorXd relative_residuals(const FeSystem& system, const EigenPairs& pairs) {
  const Eigen::MatrixXd KX = multiply(system.stiffness.get(), pairs.vectors);
  const Eigen::MatrixXd MX = multiply(system.mass_matrix.get(), pairs.vectors);
  return column_norms(KX - MX * pairs.values.asDiagonal()).cwiseQuotient(column_norms(KX));
}

}  // namespace microslip::fem
