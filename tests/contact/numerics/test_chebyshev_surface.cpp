#include "contact/numerics/chebyshev_surface.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace microslip::contact {
namespace {

template <typename Function>
Eigen::VectorXd line_through(int degree, const Function& f) {
  return chebyshev_transform(degree) * chebyshev_points(degree).unaryExpr(f);
}

template <typename Function>
ChebyshevSurface surface_through(int degree, const Function& f) {
  const Eigen::VectorXd& x = chebyshev_points(degree);
  Eigen::MatrixXd values(degree + 1, degree + 1);
  for (Eigen::Index i = 0; i <= degree; ++i) {
    for (Eigen::Index j = 0; j <= degree; ++j) {
      values(i, j) = f(x[i], x[j]);
    }
  }
  return ChebyshevSurface::through(values);
}

TEST(ChebyshevLine, ReproducesPolynomialsAndTheirSlopes) {
  const auto f = [](double x) { return 1.0 - 2.0 * x + 3.0 * x * x * x; };
  const Eigen::VectorXd c = line_through(4, f);
  for (const double x : {-1.0, -0.3, 0.0, 0.7, 1.0}) {
    EXPECT_NEAR(chebyshev_value(c, x), f(x), 1e-14);
    EXPECT_NEAR(chebyshev_value(chebyshev_derivative(c), x), -2.0 + 9.0 * x * x, 1e-13);
  }
}

TEST(ChebyshevLine, FindsAllZeros) {
  const std::vector<double> expected{-0.9, -0.2, 0.1, 0.1 + 1e-5, 0.5, 0.95};
  const auto f = [&](double x) {
    double product = 1.0;
    for (const double zero : expected) {
      product *= x - zero;
    }
    return product;
  };
  const std::vector<double> roots = chebyshev_roots(line_through(16, f));
  ASSERT_EQ(roots.size(), expected.size());
  for (std::size_t i = 0; i < roots.size(); ++i) {
    // Zeros 1e-5 apart amplify the rounding of the coefficients (1e-16) by their distance.
    EXPECT_NEAR(roots[i], expected[i], 1e-10);
  }
}

TEST(ChebyshevLine, HasZerosAtItsEndsButNoneWhereItIsZeroThroughout) {
  const std::vector<double> roots =
      chebyshev_roots(line_through(4, [](double x) { return x * x - 1.0; }));
  ASSERT_EQ(roots.size(), 2U);
  EXPECT_NEAR(roots[0], -1.0, 1e-15);
  EXPECT_NEAR(roots[1], 1.0, 1e-15);
  EXPECT_TRUE(chebyshev_roots(Eigen::VectorXd::Zero(5)).empty());
  EXPECT_TRUE(chebyshev_roots(Eigen::VectorXd::Ones(1)).empty());
}

TEST(ChebyshevSurface, ReproducesValuesDerivativesAndQuarters) {
  const auto f = [](double x, double y) { return 1.0 + x * x * y - 2.0 * x * y * y * y; };
  const ChebyshevSurface surface = surface_through(4, f);
  const auto quarters = surface.quarters();
  for (const double x : {-1.0, -0.4, 0.9}) {
    for (const double y : {-0.8, 0.3, 1.0}) {
      EXPECT_NEAR(surface.value(x, y), f(x, y), 1e-14);
      EXPECT_NEAR(surface.derivative_x().value(x, y), 2.0 * x * y - 2.0 * y * y * y, 1e-13);
      EXPECT_NEAR(surface.derivative_y().value(x, y), x * x - 6.0 * x * y * y, 1e-13);
      EXPECT_NEAR(quarters[1].value(x, y), f(0.5 * (x + 1.0), 0.5 * (y - 1.0)), 1e-14);
      EXPECT_NEAR(chebyshev_value(surface.column(x), y), f(x, y), 1e-14);
      EXPECT_LE(std::abs(f(x, y) - surface.coefficients()(0, 0)), surface.variation());
    }
  }
  EXPECT_LT(surface.tail(), surface.variation());
}

TEST(CommonRoots, FindsEveryCrossing) {
  // Circle of radius 0.8 and hyperbola xy = 0.1: four crossings.
  const auto circle = surface_through(8, [](double x, double y) { return x * x + y * y - 0.64; });
  const auto hyperbola = surface_through(8, [](double x, double y) { return x * y - 0.1; });
  std::vector<Eigen::Vector2d> roots = common_roots(circle, hyperbola);
  std::ranges::sort(roots, {}, [](const Eigen::Vector2d& x) { return x[0]; });
  ASSERT_EQ(roots.size(), 4U);
  for (const Eigen::Vector2d& x : roots) {
    EXPECT_NEAR(x.squaredNorm(), 0.64, 1e-14);
    EXPECT_NEAR(x[0] * x[1], 0.1, 1e-14);
  }
}

TEST(CommonRoots, FindsNothingIsolatedOnLinesThatCoincide) {
  const auto f = surface_through(4, [](double x, double y) { return x - y * y; });
  const auto g =
      surface_through(4, [](double x, double y) { return 2.0 * (x - y * y) * (3.0 + x); });
  EXPECT_TRUE(common_roots(f, g).empty());
}

TEST(CommonRoots, FindsATouchingPointOfHigherOrderApproximately) {
  const auto f = surface_through(4, [](double, double y) { return y - 0.3; });
  const auto g =
      surface_through(4, [](double x, double y) { return y - 0.3 - (x - 0.2) * (x - 0.2); });
  const std::vector<Eigen::Vector2d> roots = common_roots(f, g);
  ASSERT_FALSE(roots.empty());
  for (const Eigen::Vector2d& x : roots) {
    // A double root is known to a few of the last boxes, 2⁻¹³ wide.
    EXPECT_NEAR(x[0], 0.2, 5e-4);
    EXPECT_NEAR(x[1], 0.3, 5e-4);
  }
}

}  // namespace
}  // namespace microslip::contact
