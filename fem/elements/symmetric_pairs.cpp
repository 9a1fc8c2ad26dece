#include "fem/elements/symmetric_pairs.hpp"

#include <Eigen/Eigenvalues>

namespace microslip::fem {

SymmetricPairs symmetric_pairs(const Eigen::MatrixXd& A) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(A);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

Eigen::VectorXd pencil_eigenvalues(const Eigen::MatrixXd& K, const Eigen::MatrixXd& M) {
  return Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>(K, M, Eigen::EigenvaluesOnly)
      .eigenvalues();
}

}  // namespace microslip::fem
