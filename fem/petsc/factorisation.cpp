#include "fem/petsc/factorisation.hpp"

#include <chrono>
#include <cmath>
#include <string>

#include "fem/elements/number_text.hpp"
#include "fem/petsc/petsc_check.hpp"
#include "fem/petsc_error.hpp"

namespace microslip::fem {
namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

PetscInt info(Mat factor, PetscInt which) {
  PetscInt value = 0;
  check(MatMumpsGetInfog(factor, which, &value));
  return value;
}

// MUMPS users' guide 5.5, section 8: −8, −9, −11 … workspace guessed too small; −13 allocation
// failed.
bool workspace_too_small(PetscInt code) {
  return code == -8 || code == -9 || code == -17 || code == -20;
}

[[noreturn]] void fail(Mat factor, const char* stage) {
  const PetscInt code = info(factor, 1);
  const std::string text = std::string("MUMPS failed in ") + stage +
                           ", INFOG(1) = " + std::to_string(code) +
                           ", INFOG(2) = " + std::to_string(info(factor, 2));
  if (code == -13 || code == -19 || workspace_too_small(code)) {
    throw MemoryError(
        "out of memory: " + text + "; about " + std::to_string(info(factor, 17)) +
        " MB are needed. Use the iterative solver, a coarser mesh or a machine with more memory.");
  }
  throw PetscError(text);
}

// Of a solve, whose workspace MUMPS allocates then.
void check_solution(int code, Mat factor) {
  try {
    check(code);
  } catch (const PetscError&) {
    if (info(factor, 1) < 0) fail(factor, "the solution");
    throw;
  }
}

void refuse_beyond(double available_mb, PetscInt needed_mb) {
  if (static_cast<double>(needed_mb) <= available_mb) return;
  throw MemoryError(
      "out of memory: the factorisation needs about " + std::to_string(needed_mb) + " MB, " +
      number_text(std::floor(available_mb)) +
      " MB are available. Use the iterative solver, a coarser mesh or a machine with more memory.");
}

}  // namespace

Factorisation::Factorisation(Mat matrix, FactorKind kind, double memory_mb) {
  const bool definite = kind == FactorKind::positive_definite;
  check(MatSetOption(matrix, MAT_SPD, definite ? PETSC_TRUE : PETSC_FALSE));
  check(MatGetFactor(matrix, MATSOLVERMUMPS, MAT_FACTOR_CHOLESKY, factor_.out()));
  check(MatMumpsSetIcntl(factor_.get(), 13, 1));  // no ScaLAPACK root: it would hide pivot signs
  check(MatMumpsSetIcntl(factor_.get(), 24, definite ? 0 : 1));
  check(MatMumpsSetIcntl(factor_.get(), 31, kind == FactorKind::inertia_only ? 1 : 0));
  MatFactorInfo options;
  check(MatFactorInfoInitialize(&options));
  const auto start = std::chrono::steady_clock::now();
  check(MatCholeskyFactorSymbolic(factor_.get(), matrix, nullptr, &options));
  if (info(factor_.get(), 1) < 0) fail(factor_.get(), "ordering");
  refuse_beyond(memory_mb, info(factor_.get(), 17));
  ordering_seconds_ = seconds_since(start);
  for (const PetscInt extra_percent : {30, 100, 300}) {
    check(MatMumpsSetIcntl(factor_.get(), 14, extra_percent));
    check(MatCholeskyFactorNumeric(factor_.get(), matrix, &options));
    if (!workspace_too_small(info(factor_.get(), 1))) break;
  }
  if (info(factor_.get(), 1) < 0) fail(factor_.get(), "factorisation");
  factor_seconds_ = seconds_since(start) - ordering_seconds_;
}

Eigen::MatrixXd Factorisation::solve(const Eigen::MatrixXd& rhs) const {
  Eigen::MatrixXd solution(rhs.rows(), rhs.cols());
  Eigen::MatrixXd load = rhs;  // PETSc wants it writable
  const auto n_local = static_cast<PetscInt>(rhs.rows());
  const auto n_columns = static_cast<PetscInt>(rhs.cols());
  MatHandle B;
  MatHandle X;
  check(MatCreateDense(PETSC_COMM_WORLD, n_local, PETSC_DECIDE, PETSC_DETERMINE, n_columns,
                       load.data(), B.out()));
  check(MatCreateDense(PETSC_COMM_WORLD, n_local, PETSC_DECIDE, PETSC_DETERMINE, n_columns,
                       solution.data(), X.out()));
  check_solution(MatMatSolve(factor_.get(), B.get(), X.get()), factor_.get());
  return solution;
}

void Factorisation::apply(Vec rhs, Vec solution) const {
  check_solution(MatSolve(factor_.get(), rhs, solution), factor_.get());
}

Inertia Factorisation::inertia() const {
  return {.negative = info(factor_.get(), 12), .zero = info(factor_.get(), 28)};
}

}  // namespace microslip::fem
