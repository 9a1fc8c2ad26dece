#include "contact/numerics/polynomial_basis.hpp"

#include <gtest/gtest.h>

namespace microslip::contact::test_polynomial_basis {
namespace {

TEST(PolynomialBasis, TermsAreLegendreProductsByTotalDegree) {
  const Eigen::VectorXd p = Eigen::Vector3d(1.0, 3.0, 2.5);  // scaled: −1, 1, 0.5
  const Eigen::VectorXd r = Eigen::Vector3d(0.0, 4.0, 3.0);  // scaled: −1, 1, 0.5
  const PolynomialBasis basis(p, r, 2);
  EXPECT_EQ(PolynomialBasis::n_terms(2), 6);
  const Eigen::RowVectorXd last = basis.at(p, r).row(2);
  Eigen::RowVectorXd expected(6);
  expected << 1.0, 0.5, 0.5, -0.125, 0.25, -0.125;  // P₂(½) = (3/4 − 1)/2
  EXPECT_EQ(last, expected);
}

TEST(PolynomialBasis, DirectionWithoutExtentIsAllowed) {
  const Eigen::VectorXd p = Eigen::Vector2d(1.0, 3.0);
  const Eigen::VectorXd r = Eigen::Vector2d(7.0, 7.0);
  EXPECT_TRUE(PolynomialBasis(p, r, 3).at(p, r).allFinite());
}

}  // namespace
}  // namespace microslip::contact::test_polynomial_basis
