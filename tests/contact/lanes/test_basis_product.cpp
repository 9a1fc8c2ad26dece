#include "contact/lanes/basis_product.hpp"

#include <gtest/gtest.h>

namespace microslip::contact::test_basis_product {
namespace {

// More rows than are kept before they are multiplied, and the same object for another size.
TEST(BasisProduct, IsTheSumOfItsOuterProducts) {
  BasisProduct product;
  for (const Eigen::Index n_basis : {11, 3}) {
    const Eigen::Index n_columns = 6 * n_basis + 6;
    product.start(n_basis, n_columns);
    Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(n_basis, n_columns);
    for (int i = 0; i < 700; ++i) {
      const Eigen::VectorXd basis = Eigen::VectorXd::Random(n_basis);
      const Eigen::RowVectorXd row = Eigen::RowVectorXd::Random(n_columns);
      product.add(basis, 0.5) = row;
      expected += 0.5 * basis * row;
    }
    EXPECT_LT((product.sum() - expected).cwiseAbs().maxCoeff(), 1e-12);
  }
}

}  // namespace
}  // namespace microslip::contact::test_basis_product
