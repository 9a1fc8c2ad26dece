#include "fem/eigensolver.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include <slepceps.h>

#include "fem/petsc_check.hpp"

namespace microslip::fem {
namespace {

// Of the shift-inverted values; the pairs themselves are judged by their residual afterwards.
constexpr double eigensolver_tolerance = 1e-12;
constexpr int max_restarts = 200;

/// (K − σM)⁻¹ M as SLEPc's spectral transformation: factorisation and its timings stay ours.
struct ShiftInvert {
  Mat mass;
  const Factorisation* inverse;
  double shift;
  VecHandle work;
};

PetscErrorCode apply(ST transformation, Vec x, Vec y) {
  void* context = nullptr;
  try {
    check(STShellGetContext(transformation, &context));
    const auto* self = static_cast<ShiftInvert*>(context);
    check(MatMult(self->mass, x, self->work.get()));
    self->inverse->solve(self->work.get(), y);
  } catch (const PetscError&) {
    return PETSC_ERR_LIB;  // no exception may cross the library
  }
  return 0;
}

PetscErrorCode back_transform(ST transformation, PetscInt n, PetscScalar* real,
                              PetscScalar* /*imaginary*/) {
  void* context = nullptr;
  const PetscErrorCode code = STShellGetContext(transformation, &context);
  if (code != 0) return code;
  const double shift = static_cast<ShiftInvert*>(context)->shift;
  for (PetscInt i = 0; i < n; ++i) real[i] = shift + 1.0 / real[i];
  return 0;
}

using EpsHandle = Handle<EPS, &EPSDestroy>;

EpsHandle make_solver(const FeSystem& system, ShiftInvert& transformation, Eigen::Index n_pairs,
                      Eigen::Index n_basis) {
  EpsHandle solver;
  check(EPSCreate(PETSC_COMM_WORLD, solver.out()));
  check(EPSSetOperators(solver.get(), system.stiffness.get(), system.mass.get()));
  check(EPSSetProblemType(solver.get(), EPS_GHEP));
  check(EPSSetType(solver.get(), EPSKRYLOVSCHUR));
  check(EPSSetDimensions(solver.get(), static_cast<PetscInt>(n_pairs),
                         n_basis > 0 ? static_cast<PetscInt>(n_basis) : PETSC_DEFAULT,
                         PETSC_DEFAULT));
  check(EPSSetTolerances(solver.get(), eigensolver_tolerance, max_restarts));
  // Largest 1/(λ − σ) are the λ next above σ, which lies below the spectrum.
  check(EPSSetWhichEigenpairs(solver.get(), EPS_LARGEST_REAL));
  ST st = nullptr;
  check(EPSGetST(solver.get(), &st));
  check(STSetType(st, STSHELL));
  check(STShellSetContext(st, &transformation));
  check(STShellSetApply(st, &apply));
  check(STShellSetBackTransform(st, &back_transform));
  return solver;
}

struct Judged {
  double value;
  double residual;
};

/// Normalises φ to φᵀMφ = 1 and replaces λ by its Rayleigh quotient.
Judged judge(const FeSystem& system, double shift, Vec phi, Vec k_phi, Vec m_phi) {
  check(MatMult(system.mass.get(), phi, m_phi));
  PetscScalar mass = 0.0;
  check(VecDot(phi, m_phi, &mass));
  check(VecScale(phi, 1.0 / std::sqrt(mass)));
  check(VecScale(m_phi, 1.0 / std::sqrt(mass)));
  check(MatMult(system.stiffness.get(), phi, k_phi));
  PetscScalar value = 0.0;
  check(VecDot(phi, k_phi, &value));
  PetscReal force = 0.0;
  PetscReal inertia = 0.0;
  check(VecNorm(k_phi, NORM_2, &force));
  check(VecNorm(m_phi, NORM_2, &inertia));
  check(VecAXPY(k_phi, -value, m_phi));
  PetscReal residual = 0.0;
  check(VecNorm(k_phi, NORM_2, &residual));
  return {value, residual / std::max(force, std::abs(shift) * inertia)};
}

}  // namespace

EigenPairs lowest_pairs(const FeSystem& system, const Factorisation& inverse, double shift,
                        Eigen::Index n_pairs, Eigen::Index n_basis) {
  ShiftInvert transformation{system.mass.get(), &inverse, shift, make_vector(system.mass.get())};
  const EpsHandle solver = make_solver(system, transformation, n_pairs, n_basis);
  check(EPSSolve(solver.get()));
  PetscInt n_found = 0;
  check(EPSGetConverged(solver.get(), &n_found));
  const VecHandle phi = make_vector(system.mass.get());
  const VecHandle k_phi = make_vector(system.mass.get());
  const VecHandle m_phi = make_vector(system.mass.get());
  std::vector<Judged> judged;
  std::vector<Eigen::VectorXd> vectors;
  for (PetscInt i = 0; i < n_found; ++i) {
    check(EPSGetEigenvector(solver.get(), i, phi.get(), nullptr));
    judged.push_back(judge(system, shift, phi.get(), k_phi.get(), m_phi.get()));
    vectors.push_back(gather(phi.get()));
  }
  std::vector<std::size_t> order(judged.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return judged[a].value < judged[b].value; });
  const auto n = static_cast<Eigen::Index>(order.size());
  PetscInt size = 0;
  check(VecGetSize(phi.get(), &size));
  EigenPairs pairs{Eigen::VectorXd(n), Eigen::MatrixXd(size, n), Eigen::VectorXd(n)};
  for (Eigen::Index i = 0; i < n; ++i) {
    const std::size_t k = order[static_cast<std::size_t>(i)];
    pairs.values[i] = judged[k].value;
    pairs.residual[i] = judged[k].residual;
    pairs.vectors.col(i) = vectors[k];
  }
  return pairs;
}

}  // namespace microslip::fem
