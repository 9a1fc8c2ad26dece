#include "contact/dense.hpp"
#include "tests/support/floating_point_traps.hpp"

#include <cmath>
#include <complex>
#include <limits>
#include <random>

#include <gtest/gtest.h>
#include <Eigen/LU>

namespace microslip::contact::test_dense {
namespace {

Eigen::MatrixXd random_matrix(Eigen::Index n, unsigned seed) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal;
  return Eigen::MatrixXd::NullaryExpr(n, n, [&] { return normal(generator); });
}

/// On either side of the size from which LAPACK is called.
class DenseOfSize : public testing::TestWithParam<Eigen::Index> {};
INSTANTIATE_TEST_SUITE_P(Sizes, DenseOfSize, testing::Values(1, 5, 63, 64, 150));

TEST_P(DenseOfSize, FactorsSolveBothWays) {
  const Eigen::MatrixXd A = random_matrix(GetParam(), 1);
  const Eigen::MatrixXd B = random_matrix(GetParam(), 2).leftCols(1);
  const LuFactors factors(A);
  EXPECT_LT((A * factors.solve(B) - B).norm(), 1e-10 * B.norm());
  EXPECT_LT((A.transpose() * factors.solve_transposed(B) - B).norm(), 1e-10 * B.norm());
  EXPECT_LT((A * solved(A, B) - B).norm(), 1e-10 * B.norm());
}

TEST_P(DenseOfSize, SignOfTheDeterminant) {
  for (unsigned seed = 0; seed < 8; ++seed) {
    Eigen::MatrixXd A = random_matrix(GetParam(), seed);
    A /= std::sqrt(static_cast<double>(GetParam()));
    const double sign = Eigen::FullPivLU<Eigen::MatrixXd>(A).determinant() > 0.0 ? 1.0 : -1.0;
    EXPECT_EQ(LuFactors(A).sign_of_determinant(), sign) << seed;
    A.col(0).setZero();
    EXPECT_EQ(LuFactors(A).sign_of_determinant(), 0.0) << seed;
  }
}

TEST_P(DenseOfSize, PairsAreOfTheMatrix) {
  const Eigen::MatrixXd A = random_matrix(GetParam(), 3);
  const auto pairs = general_pairs(A);
  const auto values = general_eigenvalues(A);
  ASSERT_TRUE(pairs && values);
  ASSERT_EQ(pairs->values.size(), GetParam());
  for (Eigen::Index i = 0; i < GetParam(); ++i) {
    const Eigen::VectorXcd v = pairs->vectors.col(i);
    EXPECT_NEAR(v.norm(), 1.0, 1e-12);
    EXPECT_LT((A.cast<std::complex<double>>() * v - pairs->values[i] * v).norm(), 1e-10 * A.norm());
  }
  EXPECT_LT(std::abs(values->sum() - A.trace()), 1e-9 * A.norm());
}

TEST_P(DenseOfSize, PairsThatAreWanted) {
  const Eigen::MatrixXd A = random_matrix(GetParam(), 5);
  const auto wanted = [](std::complex<double> value) { return value.real() > 0.5; };
  const auto pairs = general_pairs(A, wanted);
  const auto all = general_eigenvalues(A);
  ASSERT_TRUE(pairs && all);
  EXPECT_LT(std::abs(pairs->values.sum() - all->sum()), 1e-10 * A.norm());
  for (Eigen::Index i = 0; i < GetParam(); ++i) {
    const Eigen::VectorXcd v = pairs->vectors.col(i);
    const std::complex<double> value = pairs->values[i];
    EXPECT_LT((all->array() - value).abs().minCoeff(), 1e-10 * A.norm());
    EXPECT_NEAR(v.norm(), wanted(value) ? 1.0 : 0.0, 1e-12);
    EXPECT_LT((A.cast<std::complex<double>>() * v - value * v).norm(), 1e-10 * A.norm());
  }
}

TEST_P(DenseOfSize, NullDirectionOrNone) {
  const Eigen::Index n = GetParam();
  Eigen::MatrixXd A = random_matrix(n + 1, 4).topRows(n);
  const auto y = null_direction(A);
  ASSERT_TRUE(y.has_value());
  EXPECT_NEAR(y->norm(), 1.0, 1e-14);
  EXPECT_LT((A * *y).norm(), 1e-13 * A.norm());
  A.row(0) = n > 1 ? Eigen::RowVectorXd(2.0 * A.row(n - 1)) : Eigen::RowVectorXd::Zero(n + 1);
  EXPECT_FALSE(null_direction(A).has_value());
}

TEST(Dense, ExponentialOfARotationTurnsIt) {
  // Of a generator of any size: squarings lose digits by its norm.
  for (const double angle : {1e-9, 0.3, 40.0, 3e4}) {
    Eigen::Matrix2d generator;
    generator << 0.0, angle, -angle, 0.0;
    Eigen::Matrix2d turned;
    turned << std::cos(angle), std::sin(angle), -std::sin(angle), std::cos(angle);
    EXPECT_LT((exponential(generator) - turned).norm(), 1e-15 * (10.0 + angle)) << angle;
  }
}

TEST(Dense, ExponentialsOfOneMatrixMultiply) {
  const Eigen::MatrixXd A = random_matrix(12, 7);
  const Eigen::MatrixXd product = exponential(0.7 * A) * exponential(0.3 * A);
  EXPECT_LT((exponential(A) - product).norm(), 1e-13 * product.norm());
}

TEST(Dense, InverseOrNone) {
  const Eigen::MatrixXd A = random_matrix(7, 5);
  const auto inverse = inverted(A);
  ASSERT_TRUE(inverse.has_value());
  EXPECT_LT((*inverse * A - Eigen::MatrixXd::Identity(7, 7)).norm(), 1e-12);
  EXPECT_FALSE(inverted(Eigen::MatrixXd(Eigen::MatrixXd::Zero(3, 3))).has_value());
  EXPECT_FALSE(inverted(Eigen::MatrixXcd(Eigen::MatrixXcd::Ones(2, 2))).has_value());
}

TEST(Dense, WhatIsNotFiniteHasNoEigenvalues) {
  const tests::UntrappedFloatingPoint nan_is_compared;  // by OpenBLAS
  Eigen::MatrixXd A = random_matrix(100, 4);
  A(3, 7) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(general_pairs(A).has_value());
  EXPECT_FALSE(LuFactors(A).solve(Eigen::MatrixXd::Ones(100, 1)).allFinite());
}

}  // namespace
}  // namespace microslip::contact::test_dense
