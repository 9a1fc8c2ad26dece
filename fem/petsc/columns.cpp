#include "fem/petsc/columns.hpp"

#include <Eigen/Cholesky>

#include "fem/petsc/petsc_check.hpp"

namespace microslip::fem {

VecHandle view_column(Eigen::Ref<Eigen::VectorXd> local) {
  VecHandle vector;
  check(VecCreateMPIWithArray(PETSC_COMM_WORLD, 1, static_cast<PetscInt>(local.size()),
                              PETSC_DECIDE, local.data(), vector.out()));
  return vector;
}

Eigen::MatrixXd multiply(Mat A, const Eigen::MatrixXd& X) {
  Eigen::MatrixXd Y(X.rows(), X.cols());
  Eigen::VectorXd input(X.rows());
  for (Eigen::Index j = 0; j < X.cols(); ++j) {
    input = X.col(j);
    const VecHandle x = view_column(input);
    const VecHandle y = view_column(Y.col(j));
    check(MatMult(A, x.get(), y.get()));
  }
  return Y;
}

Eigen::MatrixXd inner_products(const Eigen::MatrixXd& X, const Eigen::MatrixXd& Y) {
  const Eigen::MatrixXd local = X.transpose() * Y;
  Eigen::MatrixXd sum(local.rows(), local.cols());
  check(MPI_Allreduce(local.data(), sum.data(), static_cast<int>(local.size()), MPI_DOUBLE, MPI_SUM,
                      PETSC_COMM_WORLD));
  return sum;
}

Eigen::VectorXd column_norms(const Eigen::MatrixXd& X) {
  const Eigen::VectorXd local = X.colwise().squaredNorm().transpose();
  Eigen::VectorXd sum(local.size());
  check(MPI_Allreduce(local.data(), sum.data(), static_cast<int>(local.size()), MPI_DOUBLE, MPI_SUM,
                      PETSC_COMM_WORLD));
  return sum.cwiseSqrt();
}

Eigen::MatrixXd mass_orthonormal(Mat M, const Eigen::MatrixXd& X) {
  Eigen::MatrixXd Q = X;
  for (int pass = 0; pass < 2; ++pass) {  // the second removes what rounding left of the first
    const Eigen::LLT<Eigen::MatrixXd> gram(inner_products(Q, multiply(M, Q)));
    Q = gram.matrixL().solve(Q.transpose()).transpose().eval();
  }
  return Q;
}

}  // namespace microslip::fem
