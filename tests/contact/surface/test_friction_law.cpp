#include "contact/surface/friction_law.hpp"
#include "tests/support/floating_point_traps.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

namespace microslip::contact::test_friction_law {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double eps = std::numeric_limits<double>::epsilon();

TEST(FrictionLaw, FollowsItsFormula) {
  const FrictionLaw exponential = FrictionLaw::exponential(0.5, 0.3, 2.0);
  const FrictionLaw hyperbolic = FrictionLaw::hyperbolic(0.5, 2.0);
  for (const double rate : {0.0, 1e-6, 0.1, 1.0, 30.0}) {
    // A few roundings of numbers below one.
    EXPECT_NEAR(exponential.at(rate).value, 0.3 + 0.2 * std::exp(-2.0 * rate), 2.0 * eps);
    EXPECT_NEAR(hyperbolic.at(rate).value, 0.5 / (1.0 + 2.0 * rate), 2.0 * eps);
    EXPECT_EQ(FrictionLaw::constant(0.4).at(rate).value, 0.4);
  }
}

TEST(FrictionLaw, DerivativeIsThatOfTheValue) {
  for (const FrictionLaw& law :
       {FrictionLaw::exponential(0.5, 0.3, 2.0), FrictionLaw::exponential(0.1, 0.6, 3.0),
        FrictionLaw::hyperbolic(0.5, 2.0)}) {
    for (const double rate : {0.01, 0.3, 2.0}) {
      const double h = 1e-4;
      const double difference = (8.0 * (law.at(rate + h).value - law.at(rate - h).value) -
                                 (law.at(rate + 2.0 * h).value - law.at(rate - 2.0 * h).value)) /
                                (12.0 * h);
      // h⁴ times fifth derivatives below 1e4, and rounding over h.
      EXPECT_NEAR(law.at(rate).by_rate, difference, 1e-11);
    }
  }
}

// Between two grades twelve values tell the coefficient everywhere.
TEST(FrictionLaw, IsAPolynomialBetweenItsGrades) {
  constexpr double fastest = 1e4;  // below 1e6 of the decay
  for (const FrictionLaw& law :
       {FrictionLaw::exponential(0.5, 0.3, 2.0), FrictionLaw::exponential(0.0, 0.6, 3.0),
        FrictionLaw::hyperbolic(0.5, 2.0)}) {
    std::vector<double> speeds;
    law.grades(fastest, speeds);
    ASSERT_FALSE(speeds.empty());
    ASSERT_LT(speeds.back(), fastest);
    double low = 0.0;
    speeds.push_back(fastest);
    for (const double high : speeds) {
      ASSERT_GT(high, low);
      constexpr int n = 12;
      double largest = 0.0;
      for (const double x : {-0.99, -0.7, -0.31, 0.05, 0.42, 0.93}) {
        double above = 0.0;  // barycentric interpolation at Chebyshev points
        double below = 0.0;
        for (int i = 0; i < n; ++i) {
          const double angle = std::numbers::pi * (i + 0.5) / n;
          const double weight = (i % 2 == 0 ? 1.0 : -1.0) * std::sin(angle) / (x - std::cos(angle));
          above += weight * law.at(low + 0.5 * (high - low) * (1.0 + std::cos(angle))).value;
          below += weight;
        }
        const double exact = law.at(low + 0.5 * (high - low) * (1.0 + x)).value;
        largest = std::max(largest, std::abs(above / below - exact));
      }
      // Of (1) from 16 to 40 times its decay and of (2) from one grade to the next: 3.6⁻¹² of μ₀.
      EXPECT_LT(largest, 2e-7) << low;
      low = high;
    }
  }
}

TEST(FrictionLaw, HasNoGradesWhereItHardlyChanges) {
  std::vector<double> speeds{1.0};
  FrictionLaw::constant(0.3).grades(1e9, speeds);
  EXPECT_TRUE(speeds.empty());
  FrictionLaw::exponential(0.3, 0.2, 1e-3).grades(999.0, speeds);
  EXPECT_TRUE(speeds.empty());
  FrictionLaw::exponential(0.3, 0.2, 1e-3).grades(infinity, speeds);
  EXPECT_EQ(speeds, (std::vector<double>{1e3, 4e3, 16e3, 40e3}));
  FrictionLaw::hyperbolic(0.3, 1e300).grades(infinity, speeds);
  EXPECT_TRUE(std::isfinite(speeds.back()));
}

TEST(FrictionLaw, WithoutDecayIsConstant) {
  for (const FrictionLaw& law :
       {FrictionLaw::exponential(0.5, 0.3, 0.0), FrictionLaw::hyperbolic(0.5, 0.0),
        FrictionLaw::exponential(0.5, 0.5, 7.0), FrictionLaw::constant(0.5)}) {
    EXPECT_FALSE(law.is_rate_dependent());
    for (const double rate : {0.0, 1.0, 1e300}) {
      EXPECT_EQ(law.at(rate).value, 0.5);
      EXPECT_EQ(law.at(rate).by_rate, 0.0);
    }
  }
  EXPECT_TRUE(FrictionLaw::exponential(0.5, 0.3, 1e-9).is_rate_dependent());
  EXPECT_TRUE(FrictionLaw::hyperbolic(0.5, 1e-9).is_rate_dependent());
}

TEST(FrictionLaw, FastDecayLeavesTheLimitAtSpeed) {
  const tests::UntrappedFloatingPoint decay_times_rate_is_infinite;
  for (const double decay : {1e3, 1e100, 1e308}) {
    const FrictionLaw exponential = FrictionLaw::exponential(0.5, 0.3, decay);
    const FrictionLaw hyperbolic = FrictionLaw::hyperbolic(0.5, decay);
    EXPECT_EQ(exponential.at(0.0).value, 0.5);
    EXPECT_EQ(hyperbolic.at(0.0).value, 0.5);
    for (const double rate : {1.0, 1e300}) {
      EXPECT_EQ(exponential.at(rate).value, 0.3);  // e^{−1000} is 0
      EXPECT_EQ(exponential.at(rate).by_rate, 0.0);
      EXPECT_LE(hyperbolic.at(rate).value, 0.5 / decay);
      EXPECT_TRUE(std::isfinite(hyperbolic.at(rate).by_rate));
    }
  }
}

TEST(FrictionLaw, KeepsACoefficientAtRestFarBelowTheOther) {
  EXPECT_EQ(FrictionLaw::exponential(1e-30, 1.0, 1.0).at(0.0).value, 1e-30);
}

TEST(FrictionLaw, RefusesValuesOutOfRangeByName) {
  const auto message = [](auto make) -> std::string {
    try {
      (void)make();
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(message([] { return FrictionLaw::constant(-0.1); }).find("coefficient = -0.1"),
            std::string::npos);
  EXPECT_NE(message([] { return FrictionLaw::exponential(infinity, 0.1, 1.0); }).find("at rest"),
            std::string::npos);
  EXPECT_NE(message([] { return FrictionLaw::exponential(0.1, -1.0, 1.0); }).find("at speed"),
            std::string::npos);
  EXPECT_NE(message([] { return FrictionLaw::exponential(0.1, 0.1, -1.0); }).find("decay = -1"),
            std::string::npos);
  EXPECT_NE(message([] { return FrictionLaw::hyperbolic(std::nan(""), 1.0); }).find("nan"),
            std::string::npos);
  EXPECT_NE(message([] { return FrictionLaw::hyperbolic(0.3, -1.0); }).find("decay"),
            std::string::npos);
}

}  // namespace
}  // namespace microslip::contact::test_friction_law
