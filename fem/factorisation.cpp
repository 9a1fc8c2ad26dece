#include "fem/factorisation.hpp"

#include <chrono>
#include <new>
#include <string>

#include "fem/petsc_check.hpp"

namespace microslip::fem {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

void check_factor(Mat factor, double shift) {
  MatFactorError error = MAT_FACTOR_NOERROR;
  check(MatFactorGetError(factor, &error));
  if (error == MAT_FACTOR_NOERROR) return;
  if (error == MAT_FACTOR_OUTMEMORY) throw std::bad_alloc();
  throw EigenError("the factorisation of K - " + std::to_string(shift) +
                   " M broke down: the matrix is singular or not positive definite (MatFactorError " +
                   std::to_string(static_cast<int>(error)) + ")");
}

/// A dense copy of the rows of this rank.
MatHandle distributed(Mat like, const Eigen::MatrixXd& full) {
  PetscInt begin = 0;
  PetscInt end = 0;
  check(MatGetOwnershipRange(like, &begin, &end));
  MatHandle matrix;
  check(MatCreateDense(PETSC_COMM_WORLD, end - begin, PETSC_DECIDE,
                       static_cast<PetscInt>(full.rows()), static_cast<PetscInt>(full.cols()),
                       nullptr, matrix.out()));
  PetscScalar* values = nullptr;
  PetscInt stride = 0;
  check(MatDenseGetLDA(matrix.get(), &stride));
  check(MatDenseGetArray(matrix.get(), &values));
  for (Eigen::Index j = 0; j < full.cols(); ++j) {
    Eigen::Map<Eigen::VectorXd>(values + j * stride, end - begin) =
        full.col(j).segment(begin, end - begin);
  }
  check(MatDenseRestoreArray(matrix.get(), &values));
  check(MatAssemblyBegin(matrix.get(), MAT_FINAL_ASSEMBLY));
  check(MatAssemblyEnd(matrix.get(), MAT_FINAL_ASSEMBLY));
  return matrix;
}

}  // namespace

Factorisation::Factorisation(const FeSystem& system, double shift, Kind kind) {
  Mat source = system.stiffness.get();
  if (shift != 0.0) {
    check(MatDuplicate(system.stiffness.get(), MAT_COPY_VALUES, matrix_.out()));
    check(MatAXPY(matrix_.get(), -shift, system.mass.get(), SAME_NONZERO_PATTERN));
    check(MatSetOption(matrix_.get(), MAT_SYMMETRIC, PETSC_TRUE));
    source = matrix_.get();
  }
  const PetscBool positive =
      kind == Kind::positive_definite ? PETSC_TRUE : PETSC_FALSE;
  check(MatSetOption(source, MAT_SPD, positive));
  check(MatSetOption(source, MAT_SYMMETRIC, PETSC_TRUE));
  check(MatGetFactor(source, MATSOLVERMUMPS, MAT_FACTOR_CHOLESKY, factor_.out()));
  check(MatMumpsSetIcntl(factor_.get(), 14, 40));  // room for pivoting [%]
  MatFactorInfo info;
  check(MatFactorInfoInitialize(&info));
  auto begin = Clock::now();
  check(MatCholeskyFactorSymbolic(factor_.get(), source, nullptr, &info));
  ordering_seconds_ = seconds_since(begin);
  begin = Clock::now();
  check(MatCholeskyFactorNumeric(factor_.get(), source, &info));
  factor_seconds_ = seconds_since(begin);
  check_factor(factor_.get(), shift);
}

void Factorisation::solve(Vec b, Vec x) const { check(MatSolve(factor_.get(), b, x)); }

Eigen::MatrixXd Factorisation::solve(const Eigen::MatrixXd& right) const {
  const MatHandle b = distributed(factor_.get(), right);
  MatHandle x;
  check(MatDuplicate(b.get(), MAT_DO_NOT_COPY_VALUES, x.out()));
  check(MatMatSolve(factor_.get(), b.get(), x.get()));
  Eigen::MatrixXd solution(right.rows(), right.cols());
  for (PetscInt j = 0; j < static_cast<PetscInt>(right.cols()); ++j) {
    Vec column = nullptr;
    check(MatDenseGetColumnVecRead(x.get(), j, &column));
    solution.col(j) = gather(column);
    check(MatDenseRestoreColumnVecRead(x.get(), j, &column));
  }
  return solution;
}

PetscInt Factorisation::n_below_shift() const {
  PetscInt negative = 0;
  PetscInt zero = 0;
  PetscInt positive = 0;
  check(MatGetInertia(factor_.get(), &negative, &zero, &positive));
  return negative;
}

}  // namespace microslip::fem
