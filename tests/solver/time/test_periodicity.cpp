#include "solver/time/periodicity.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace microslip::solver::test_periodicity {
namespace {

PeriodState at(double x, double y = 0.0, double force = 0.0) {
  return {
      Eigen::Vector2d(x, y), Eigen::Vector2d::Zero(), Eigen::Vector2d(force, 0.0), 1.0, 1.0, 1.0};
}

TEST(Periodicity, IsReachedWhenADecayHasComeCloseNotWhenItIsSlow) {
  PeriodicityTest test;
  // x = 0.95ᵏ: the change is a twentieth of the distance that remains.
  double x = 1.0;
  int n = 0;
  while (test.multiple(1e-6) == 0 && n < 1000) {
    test.add(at(1.0 + x));
    x *= 0.95;
    ++n;
  }
  EXPECT_EQ(test.multiple(1e-6), 1);
  EXPECT_LT(x, 1e-6);
  EXPECT_GT(x, 0.8e-6);
}

TEST(Periodicity, ADecayThatTurnsIsNotAPeriodMultiple) {
  PeriodicityTest test;
  for (int k = 0; k < 2000; ++k) {  // a quarter turn per period
    const double r = std::pow(0.98, k);
    test.add(at(1.0 + r * std::cos(0.5 * M_PI * k), r * std::sin(0.5 * M_PI * k)));
    if (const int found = test.multiple(1e-7); found != 0) {
      EXPECT_EQ(found, 1) << k;
      return;
    }
  }
  FAIL() << "never periodic";
}

TEST(Periodicity, FindsMultiplesTwoToFour) {
  for (int m = 2; m <= 4; ++m) {
    PeriodicityTest test;
    for (int k = 0; k < 30; ++k) test.add(at(k % m + 0.1 * std::pow(0.1, k)));
    EXPECT_EQ(test.multiple(1e-7), m);
  }
}

TEST(Periodicity, IsNotFoundInAnIrregularMotion) {
  PeriodicityTest test;
  double x = 0.3;
  for (int k = 0; k < 500; ++k) {
    x = 3.9 * x * (1.0 - x);  // logistic map in its irregular range
    test.add(at(x));
    EXPECT_EQ(test.multiple(1e-7), 0);
  }
}

TEST(Periodicity, SeesSlidersThatStillMoveInTheForce) {
  PeriodicityTest test;
  for (int k = 0; k < 20; ++k) test.add(at(1.0, 0.0, 0.01 * k));
  EXPECT_EQ(test.multiple(1e-6), 0);
}

TEST(Periodicity, OfRestIsFoundAtOnce) {
  PeriodicityTest test;
  const Eigen::Vector2d zero = Eigen::Vector2d::Zero();
  for (int k = 0; k < 3; ++k) test.add({zero, zero, zero, 0.0, 0.0, 0.0});
  EXPECT_EQ(test.multiple(1e-12), 1);
}

}  // namespace
}  // namespace microslip::solver::test_periodicity
