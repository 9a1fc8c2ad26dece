#include "contact/patch/patch_quadrature.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

#include "contact/numerics/gauss_legendre.hpp"

namespace microslip::contact {
namespace {

// Polynomial of degree 3 in each coordinate, and its integral over [0, 2] × [0, 1].
double cubic(double p, double r) { return (1.0 + p * p * p) * (2.0 - r + r * r * r); }
constexpr double cubic_integral = (2.0 + 4.0) * (2.0 - 0.5 + 0.25);

template <typename Function>
double integral(const PatchRule& rule, const Function& f) {
  double sum = 0.0;
  for (Eigen::Index i = 0; i < rule.n_points(); ++i) {
    sum += rule.weights[i] * f(rule.p[i], rule.r[i]);
  }
  return sum;
}

// L-shape of area 3 from three unit squares, one of them cut into two triangles.
PatchCells l_shape() {
  PatchCells cells{Eigen::MatrixX2d(8, 2), Eigen::MatrixX4i(4, 4)};
  cells.vertices << 0, 0, 1, 0, 2, 0, 0, 1, 1, 1, 2, 1, 0, 2, 1, 2;
  cells.corners << 0, 1, 4, 3, 1, 2, 5, 4, 3, 4, 7, -1, 3, 7, 6, -1;
  return cells;
}

TEST(GaussLegendre, IntegratesPolynomialsOfTwiceItsOrderLessOne) {
  for (int order = 1; order <= 40; ++order) {
    const LineRule rule = gauss_legendre(order);
    for (int degree = 0; degree < 2 * order; ++degree) {
      EXPECT_NEAR(rule.weights.dot(rule.nodes.array().pow(degree).matrix()), 1.0 / (degree + 1.0),
                  4e-15)  // rounding of the sum
          << order << ' ' << degree;
    }
  }
}

TEST(GaussLegendre, GradingMakesRootsSmooth) {
  const LineRule plain = gauss_legendre(10);
  const auto error = [](const LineRule& rule, const auto& f, double exact) {
    return std::abs(rule.weights.dot(rule.nodes.unaryExpr(f)) - exact);
  };
  const auto left = [](double x) { return std::sqrt(x) * (1.0 + x); };
  const auto right = [&left](double x) { return left(1.0 - x); };
  const auto both = [](double x) { return std::sqrt(x * (1.0 - x)); };
  EXPECT_GT(error(plain, left, 16.0 / 15.0), 1e-5);
  EXPECT_LT(error(graded(plain, {true, false}), left, 16.0 / 15.0), 1e-15);
  EXPECT_LT(error(graded(plain, {false, true}), right, 16.0 / 15.0), 1e-15);
  EXPECT_LT(error(graded(plain, {true, true}), both, std::numbers::pi / 8.0), 1e-10);
}

TEST(GaussLegendre, RefusesNoPoints) {
  EXPECT_THROW((void)gauss_legendre(0), std::invalid_argument);
}

TEST(PatchQuadrature, GaussIsExactForPolynomialsOnRectangles) {
  const PatchRule rule = gauss_rule(rectangle_cells({0, 0}, {2, 1}, 3, 2), 2);
  EXPECT_EQ(rule.n_points(), 24);
  EXPECT_NEAR(integral(rule, cubic), cubic_integral, 1e-14);
}

TEST(PatchQuadrature, MidpointsConvergeWithTheSquareOfTheCell) {
  double before = 0.0;
  for (const int n : {8, 16, 32}) {
    const double error =
        integral(midpoint_rule(rectangle_cells({0, 0}, {2, 1}, n, n)), cubic) - cubic_integral;
    if (n > 8) {
      EXPECT_NEAR(before / error, 4.0, 0.02);  // next term is of fourth order
    }
    before = error;
  }
}

TEST(PatchQuadrature, TrianglesAndQuadrilateralsMayMix) {
  for (const int order : {2, 3, 5}) {
    const PatchRule rule = gauss_rule(l_shape(), order);
    EXPECT_NEAR(rule.weights.sum(), 3.0, 1e-14);
    EXPECT_GT(rule.weights.minCoeff(), 0.0);
    // First moments of the L: squares at 0.5, 1.5, 0.5.
    EXPECT_NEAR(integral(rule, [](double p, double) { return p; }), 2.5, 1e-14);
    EXPECT_NEAR(integral(rule, [](double, double r) { return r; }), 2.5, 1e-14);
  }
  const PatchRule rule = midpoint_rule(l_shape());
  EXPECT_NEAR(rule.weights.sum(), 3.0, 1e-15);
  EXPECT_NEAR(integral(rule, [](double p, double r) { return p - 2.0 * r; }), -2.5, 1e-14);
}

TEST(PatchQuadrature, CellsMayTurnEitherWay) {
  PatchCells cells = l_shape();
  cells.corners.row(0) << 3, 4, 1, 0;
  EXPECT_NEAR(gauss_rule(cells, 3).weights.sum(), 3.0, 1e-14);
}

// Hard case 15.
TEST(PatchQuadrature, CellsWithoutAreaAreDroppedAndCounted) {
  PatchCells cells = l_shape();
  cells.corners.conservativeResize(5, 4);
  cells.corners.row(4) << 0, 1, 2, -1;
  for (const PatchRule& rule : {midpoint_rule(cells), gauss_rule(cells, 2)}) {
    EXPECT_EQ(rule.n_dropped_cells, 1);
    EXPECT_NEAR(rule.weights.sum(), 3.0, 1e-14);
  }
  cells.corners = Eigen::MatrixX4i(cells.corners.bottomRows(1));
  EXPECT_THROW((void)midpoint_rule(cells), std::invalid_argument);
}

void expect_refused(const PatchCells& cells, const std::string& expected) {
  try {
    (void)midpoint_rule(cells);
    ADD_FAILURE() << "expected a refusal: " << expected;
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find(expected), std::string::npos) << error.what();
  }
}

TEST(PatchQuadrature, RefusesBrokenCellsByName) {
  PatchCells cells = l_shape();
  cells.corners(1, 2) = 8;
  expect_refused(cells, "patch cell 2: vertex index 8");
  cells = l_shape();
  cells.vertices(7, 0) = std::numeric_limits<double>::quiet_NaN();
  expect_refused(cells, "patch cell 3: vertex 7 is not finite");
  cells = l_shape();
  cells.vertices.row(4) << 0.2, 0.2;  // dents the first square
  expect_refused(cells, "patch cell 1 is not convex");
  EXPECT_THROW((void)rectangle_cells({0, 0}, {1, 1}, 0, 1), std::invalid_argument);
}

}  // namespace
}  // namespace microslip::contact
