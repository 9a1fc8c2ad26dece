#include "contact/dense.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>

namespace microslip::contact {

struct LuFactors::Factors {
  Eigen::PartialPivLU<Eigen::MatrixXd> lu;
};

LuFactors::LuFactors(const Eigen::MatrixXd& A)
    : factors_(std::make_unique<Factors>(Factors{Eigen::PartialPivLU<Eigen::MatrixXd>(A)})) {}
LuFactors::~LuFactors() = default;
LuFactors::LuFactors(LuFactors&&) noexcept = default;
LuFactors& LuFactors::operator=(LuFactors&&) noexcept = default;

Eigen::MatrixXd LuFactors::solve(const Eigen::Ref<const Eigen::MatrixXd>& B) const {
  return factors_->lu.solve(B);
}

Eigen::MatrixXd LuFactors::solve_transposed(const Eigen::Ref<const Eigen::MatrixXd>& B) const {
  return factors_->lu.transpose().solve(B);
}

double LuFactors::sign_of_determinant() const {
  auto sign = static_cast<double>(factors_->lu.permutationP().determinant());
  for (const double pivot : factors_->lu.matrixLU().diagonal()) {
    sign *= pivot > 0.0 ? 1.0 : (pivot < 0.0 ? -1.0 : 0.0);
  }
  return sign;
}

Eigen::MatrixXd solved(const Eigen::MatrixXd& A, const Eigen::Ref<const Eigen::MatrixXd>& B) {
  return A.partialPivLu().solve(B);
}

Eigen::MatrixXcd solved(const Eigen::MatrixXcd& A, const Eigen::Ref<const Eigen::MatrixXcd>& B) {
  return A.partialPivLu().solve(B);
}

Eigen::MatrixXd inverted(const Eigen::MatrixXd& A) { return A.partialPivLu().inverse(); }

Eigen::MatrixXcd inverted(const Eigen::MatrixXcd& A) { return A.partialPivLu().inverse(); }

Eigen::Index nullity(const Eigen::MatrixXd& A) {
  return Eigen::FullPivLU<Eigen::MatrixXd>(A).dimensionOfKernel();
}

std::optional<Eigen::VectorXd> null_direction(const Eigen::MatrixXd& A) {
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> factors(A.transpose());
  if (factors.rank() < A.rows()) return std::nullopt;
  const Eigen::MatrixXd Q = factors.householderQ();
  return Q.col(A.rows());
}

std::optional<Eigen::VectorXd> symmetric_eigenvalues(const Eigen::MatrixXd& A) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(A, Eigen::EigenvaluesOnly);
  if (solver.info() != Eigen::Success) return std::nullopt;
  return solver.eigenvalues();
}

std::optional<SymmetricPairs> symmetric_pairs(const Eigen::MatrixXd& A) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(A);
  if (solver.info() != Eigen::Success) return std::nullopt;
  return SymmetricPairs{solver.eigenvalues(), solver.eigenvectors()};
}

std::optional<SymmetricPairs> symmetric_pairs(const Eigen::MatrixXd& K, const Eigen::MatrixXd& M) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(K, M);
  if (solver.info() != Eigen::Success) return std::nullopt;
  return SymmetricPairs{solver.eigenvalues(), solver.eigenvectors()};
}

bool is_positive_definite(const Eigen::MatrixXd& A) { return A.llt().info() == Eigen::Success; }

std::optional<Eigen::VectorXcd> general_eigenvalues(const Eigen::MatrixXd& A) {
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(A, false);
  if (solver.info() != Eigen::Success) return std::nullopt;
  return solver.eigenvalues();
}

std::optional<GeneralPairs> general_pairs(const Eigen::MatrixXd& A) {
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(A);
  if (solver.info() != Eigen::Success) return std::nullopt;
  return GeneralPairs{solver.eigenvalues(), solver.eigenvectors()};
}

}  // namespace microslip::contact
