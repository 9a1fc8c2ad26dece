#include "contact/numerics/trigonometric_polynomial.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace microslip::contact::test_trigonometric_polynomial {
namespace {

constexpr double pi = std::numbers::pi;

TEST(TrigonometricPolynomial, ValueSlopeAndDerivativeAreThoseOfItsSum) {
  TrigonometricPolynomial p;
  p.reset(3);
  p.set_mean(0.7);
  p.set(1, 1.0, -2.0);
  p.set(3, 0.3, 0.4);
  TrigonometricPolynomial d;
  d.set_derivative(p);
  for (double x = -7.0; x < 14.0; x += 0.37) {
    const double value =
        0.7 + std::sin(x) - 2.0 * std::cos(x) + 0.3 * std::sin(3.0 * x) + 0.4 * std::cos(3.0 * x);
    const double slope =
        std::cos(x) + 2.0 * std::sin(x) + 0.9 * std::cos(3.0 * x) - 1.2 * std::sin(3.0 * x);
    EXPECT_NEAR(p.value(x), value, 2e-14);  // arguments up to 42 rounded at 7e-15
    EXPECT_NEAR(p.jet(x).value, value, 2e-14);
    EXPECT_NEAR(p.jet(x).slope, slope, 4e-14);
    EXPECT_NEAR(d.value(x), slope, 4e-14);
    EXPECT_NEAR(p.taylor(x).value, value, 2e-14);
    EXPECT_NEAR(p.taylor(x).slope, slope, 4e-14);
    EXPECT_NEAR(p.taylor(x).second, d.jet(x).slope, 2e-13);
    TrigonometricPolynomial second;
    second.set_derivative(d);
    EXPECT_NEAR(p.taylor(x).third, second.jet(x).slope, 6e-13);
  }
  EXPECT_EQ(p.order(), 3);
  EXPECT_DOUBLE_EQ(p.bound(2), 3.0 + 9.0 * 0.7);
}

double crossing_between(const TrigonometricPolynomial& p, double level, double low, double high) {
  return crossing(p, level, low, high, p.value(low) - level, p.value(high) - level);
}

TEST(Crossing, IsTheRootOfTheLevel) {
  TrigonometricPolynomial p;
  p.reset(1);
  p.set(1, 2.0, 0.0);
  EXPECT_NEAR(crossing_between(p, 1.0, -0.5 * pi, 0.5 * pi), pi / 6.0, 1e-15);
  EXPECT_NEAR(crossing_between(p, 2.0 - 1e-12, -0.5 * pi, 0.5 * pi), 0.5 * pi - 1e-6,
              1e-9);  // √1e-16/…
  EXPECT_NEAR(crossing_between(p, -1.0, 0.5 * pi, 1.5 * pi), 7.0 * pi / 6.0, 1e-15);
}

}  // namespace
}  // namespace microslip::contact::test_trigonometric_polynomial
