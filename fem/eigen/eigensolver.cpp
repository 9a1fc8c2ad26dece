#include "fem/eigen/eigensolver.hpp"

#include <algorithm>
#include <iterator>
#include <string>
#include <vector>

#include "fem/elements/symmetric_pairs.hpp"
#include "fem/petsc/columns.hpp"
#include "fem/petsc/guarded_solver.hpp"
#include "fem/petsc/petsc_check.hpp"
#include "fem/petsc_error.hpp"

namespace microslip::fem {
namespace {

// Of θ = 1/(λ − shift), relative. After refine() it is the bound of ‖Kφ − λMφ‖/‖Kφ‖ as well, up to
// the ratio of ‖Mφ‖ between modes (100 where elements differ 20 : 1 in size): two decades below
// what is asked.
constexpr double tolerance = 1e-10;
// Directions beside the wanted ones, and the share kept at a restart: ten modes of a clamped blade
// take 25 solves, 27 with 12 directions, 31 with 20; keeping SLEPc's 0.5 costs a few more where it
// restarts.
constexpr Eigen::Index extra_directions = 14;
constexpr Eigen::Index least_directions = 20;
constexpr double kept_share = 0.7;

void use_inverse(EPS eps, GuardedSolver& inverse, double shift) {
  ST transform = nullptr;
  KSP solver = nullptr;
  PC preconditioner = nullptr;
  check(EPSGetST(eps, &transform));
  check(STSetType(transform, STSINVERT));
  check(STSetMatMode(transform, ST_MATMODE_SHELL));  // solved with as it is
  check(EPSSetTarget(eps, shift));
  check(STGetKSP(transform, &solver));
  check(KSPSetType(solver, KSPPREONLY));
  check(KSPGetPC(solver, &preconditioner));
  use_solver(preconditioner, inverse);
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

// The Ritz values of the last iteration, converged or not, with their error estimates.
struct RitzValues {
  std::vector<double> theta;
  std::vector<double> error;  // relative
};

PetscErrorCode remember_ritz_values(EPS, PetscInt, PetscInt, PetscScalar* theta, PetscScalar*,
                                    PetscReal* error, PetscInt n, void* context) {
  auto& ritz = *static_cast<RitzValues*>(context);
  ritz.theta.assign(theta, theta + n);
  ritz.error.assign(error, error + n);
  return 0;
}

// There is an eigenvalue within error · θ of each θ: λ is not below what θ (1 + error) gives.
Eigen::VectorXd lower_estimates(const RitzValues& ritz, Eigen::Index n_converged, double shift) {
  std::vector<double> estimates;
  for (auto k = static_cast<std::size_t>(n_converged); k < ritz.theta.size(); ++k) {
    if (!(ritz.theta[k] > 0.0)) break;
    estimates.push_back(shift + 1.0 / (ritz.theta[k] * (1.0 + ritz.error[k])));
  }
  return Eigen::Map<const Eigen::VectorXd>(estimates.data(), std::ssize(estimates));
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

FoundPairs lowest_pairs(const FeSystem& system, const LinearSolver& inverse, double shift,
                        Eigen::Index n_wanted, const Eigen::MatrixXd& deflation) {
  const Eigen::Index space = 3 * system.dofs.n_free_nodes() - deflation.cols();
  const Eigen::Index n = std::min(n_wanted, space);
  const Eigen::Index subspace = std::min(std::max(n + extra_directions, least_directions), space);
  Eigen::MatrixXd known = deflation;
  RitzValues ritz;
  GuardedSolver guarded{inverse};
  EpsHandle eps;
  check(EPSCreate(PETSC_COMM_WORLD, eps.out()));
  check(EPSSetOperators(eps.get(), system.stiffness.get(), system.mass_matrix.get()));
  check(EPSSetProblemType(eps.get(), EPS_GHEP));
  check(EPSSetType(eps.get(), EPSKRYLOVSCHUR));
  check(EPSKrylovSchurSetRestart(eps.get(), kept_share));
  check(EPSSetWhichEigenpairs(eps.get(), EPS_TARGET_MAGNITUDE));
  use_inverse(eps.get(), guarded, shift);
  check(EPSSetDimensions(eps.get(), static_cast<PetscInt>(n), static_cast<PetscInt>(subspace),
                         PETSC_DEFAULT));
  check(EPSSetTolerances(eps.get(), tolerance, 300));
  check(EPSSetPurify(eps.get(), PETSC_FALSE));   // a solve per pair; refine() does it in one block
  check(EPSSetTrackAll(eps.get(), PETSC_TRUE));  // error estimates beyond the first not converged
  check(EPSMonitorSet(eps.get(), remember_ritz_values, &ritz, nullptr));
  set_deflation(eps.get(), known);
  const PetscErrorCode solved = EPSSolve(eps.get());
  guarded.rethrow();
  check(solved);
  FoundPairs found{collect(eps.get(), system.dofs.n_local_dofs()), {}};
  const Eigen::Index n_converged = found.pairs.values.size();
  if (n_converged < n) {
    throw EigenError("eigen-not-converged: " + std::to_string(n) + " modes requested, " +
                     std::to_string(n_converged) + " converged at tolerance 1e-10");
  }
  found.beyond = lower_estimates(ritz, n_converged, shift);
  return found;
}

EigenPairs refine(const FeSystem& system, const LinearSolver& inverse,
                  const Eigen::MatrixXd& vectors) {
  const Mat M = system.mass_matrix.get();
  const Eigen::MatrixXd X = mass_orthonormal(M, inverse.solve(multiply(M, vectors)));
  const Eigen::MatrixXd projected = inner_products(X, multiply(system.stiffness.get(), X));
  const SymmetricPairs ritz = symmetric_pairs(0.5 * (projected + projected.transpose()));
  return {ritz.values, X * ritz.vectors};
}

Eigen::VectorXd relative_residuals(const FeSystem& system, const EigenPairs& pairs) {
  const Eigen::MatrixXd KX = multiply(system.stiffness.get(), pairs.vectors);
  const Eigen::MatrixXd MX = multiply(system.mass_matrix.get(), pairs.vectors);
  return column_norms(KX - MX * pairs.values.asDiagonal()).cwiseQuotient(column_norms(KX));
}

}  // namespace microslip::fem
