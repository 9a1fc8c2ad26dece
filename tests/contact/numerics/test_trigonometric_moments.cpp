#include "contact/numerics/trigonometric_moments.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace microslip::contact::test_trigonometric_moments {
namespace {

// Composite Simpson with 2000 cells of b_i b_j: errs by (length h/2000)⁴ / 180 < 1e-12 here.
double integral(int i, int j, double begin, double length) {
  constexpr int n = 2000;
  double sum = 0.0;
  std::vector<double> b;
  for (int k = 0; k <= 2 * n; ++k) {
    set_basis(begin + length * k / (2.0 * n), 4, b);
    const double weight = k == 0 || k == 2 * n ? 1.0 : (k % 2 == 1 ? 4.0 : 2.0);
    sum += weight * b[static_cast<std::size_t>(i)] * b[static_cast<std::size_t>(j)];
  }
  return sum * length / (6.0 * n);
}

TEST(TrigonometricMoments, BasisIsThatOfTheConvention) {
  std::vector<double> b;
  set_basis(0.7, 3, b);
  ASSERT_EQ(b.size(), 7U);
  EXPECT_EQ(b[0], 1.0);
  for (std::size_t h = 1; h <= 3; ++h) {
    EXPECT_NEAR(b[2 * h - 1], std::sin(0.7 * static_cast<double>(h)), 1e-15);
    EXPECT_NEAR(b[2 * h], std::cos(0.7 * static_cast<double>(h)), 1e-15);
  }
}

TEST(TrigonometricMoments, ProductsAreIntegrals) {
  TrigonometricMoments moments;
  for (const double begin : {0.0, 1.3, 5.9}) {
    for (const double length : {1e-3, 0.4, 3.0}) {
      moments.reset(8);
      moments.set_piece(begin, length);
      for (int i = 0; i <= 8; ++i) {
        EXPECT_NEAR(moments.single(i), integral(i, 0, begin, length), 1e-11) << i;
        for (int j = 0; j <= 8; ++j) {
          EXPECT_NEAR(moments.product(i, j), integral(i, j, begin, length), 1e-11) << i << ' ' << j;
        }
      }
    }
  }
}

TEST(TrigonometricMoments, ShortPiecesKeepTheirDigits) {
  TrigonometricMoments moments;
  moments.reset(4);
  moments.set_piece(1.0, 1e-14);
  // sin and cos of 2 about the middle, 5e-15 further; the rest are a few roundings.
  EXPECT_NEAR(moments.single(3) / (1e-14 * std::sin(2.0 + 1e-14)), 1.0, 2e-15);
  EXPECT_NEAR(moments.single(4) / (1e-14 * std::cos(2.0 + 1e-14)), 1.0, 2e-15);
}

TEST(TrigonometricMoments, OverThePeriodTheBasisIsOrthogonal) {
  TrigonometricMoments period;
  period.reset(8);
  period.set_period();
  for (int i = 0; i <= 8; ++i) {
    for (int j = 0; j <= 8; ++j) {
      const double expected = i != j ? 0.0 : (i == 0 ? 2.0 : 1.0) * std::numbers::pi;
      EXPECT_EQ(period.product(i, j), expected) << i << ' ' << j;
    }
  }
}

TEST(TrigonometricMoments, SamplesAddUpAsPiecesDo) {
  TrigonometricMoments samples;
  TrigonometricMoments piece;
  samples.reset(4);
  piece.reset(4);
  std::vector<double> sums(9, 0.0);
  piece.set_piece(0.2, 1.0);
  std::vector<double> b;
  constexpr int n = 4000;
  for (int k = 0; k < n; ++k) {  // midpoint rule: errs by (4/n)²/24
    set_basis(0.2 + (k + 0.5) / n, 4, b);
    for (std::size_t i = 0; i < 9; ++i) sums[i] += b[i] / n;
  }
  samples.set_sums(sums.data());
  for (int i = 0; i <= 4; ++i) {
    for (int j = 0; j <= 4; ++j) EXPECT_NEAR(samples.product(i, j), piece.product(i, j), 1e-7);
  }
}

}  // namespace
}  // namespace microslip::contact::test_trigonometric_moments
