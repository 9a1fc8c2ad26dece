#include "contact/harmonics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace microslip::contact::test_harmonics {
namespace {

TEST(Harmonics, VectorIsMeansThenSinesThenCosines) {
  const Harmonics y(2, 2, Eigen::VectorXd::LinSpaced(10, 0.0, 9.0));
  EXPECT_EQ(y.n_harmonics(), 2);
  EXPECT_EQ(y.n_signals(), 2);
  EXPECT_EQ(y.mean()[1], 1.0);
  EXPECT_EQ(y.sine(1)[0], 2.0);
  EXPECT_EQ(y.cosine(1)[1], 5.0);
  EXPECT_EQ(y.sine(2)[0], 6.0);
  EXPECT_EQ(y.cosine(2)[1], 9.0);
}

TEST(Harmonics, ValueIsTheFourierSum) {
  const Harmonics y(2, 1, Eigen::Matrix<double, 5, 1>(1.0, 2.0, 3.0, 4.0, 5.0));
  const double t = 0.7;
  // Five products of order one.
  EXPECT_NEAR(y.at(t)[0],
              1.0 + 2.0 * std::sin(t) + 3.0 * std::cos(t) + 4.0 * std::sin(2.0 * t) +
                  5.0 * std::cos(2.0 * t),
              1e-14);
}

TEST(Harmonics, RefusesSizesThatDoNotFit) {
  EXPECT_THROW(Harmonics(-1, 2), std::invalid_argument);
  EXPECT_THROW(Harmonics(1, 2, Eigen::VectorXd::Zero(5)), std::invalid_argument);
}

}  // namespace
}  // namespace microslip::contact::test_harmonics
