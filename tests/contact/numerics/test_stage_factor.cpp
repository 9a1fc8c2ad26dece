#include "contact/numerics/stage_factor.hpp"

#include <gtest/gtest.h>
#include <Eigen/LU>

namespace microslip::contact::test_stage_factor {
namespace {

using Square = Eigen::Matrix<double, 5, 5>;

// Of rows in any order, so that pivots are never where they are looked for first.
TEST(StageFactor, SolvesForAnyNumberOfColumns) {
  for (int i = 0; i < 100; ++i) {
    Square A = Square::Random() + 4.0 * Square::Identity();
    A = A.rowwise().reverse().eval();
    StageFactor<5> factor;
    factor.compute(A);
    const Eigen::Matrix<double, 5, Eigen::Dynamic, Eigen::RowMajor> b =
        Eigen::MatrixXd::Random(5, 7);
    Eigen::Matrix<double, 5, Eigen::Dynamic, Eigen::RowMajor> x(5, 7);
    factor.solve(b, x);
    EXPECT_LT((A * x - b).cwiseAbs().maxCoeff(), 1e-13);
  }
}

TEST(StageFactor, TakesTheLargestPivot) {
  Square A = Square::Identity();
  A.topLeftCorner<2, 2>() << 1e-20, 1.0, 1.0, 1.0;
  StageFactor<5> factor;
  factor.compute(A);
  Eigen::Matrix<double, 5, 1> x;
  factor.solve(Eigen::Matrix<double, 5, 1>(1.0, 2.0, 3.0, 4.0, 5.0), x);
  EXPECT_LT((x - Eigen::Matrix<double, 5, 1>(1.0, 1.0, 3.0, 4.0, 5.0)).norm(), 1e-15);
}

}  // namespace
}  // namespace microslip::contact::test_stage_factor
