#include "fem/elements/quadrature.hpp"

#include <cmath>
#include <functional>

#include <gtest/gtest.h>

namespace microslip::fem::test_quadrature {
namespace {

// Weights of order one are summed over at most 125 points.
constexpr double rounding = 1e-14;

double factorial(int n) { return std::tgamma(n + 1.0); }

// ∫ ξ^a η^b ζ^c over the unit tetrahedron = a! b! c! / (a + b + c + 3)!
double tetrahedron_moment(int a, int b, int c) {
  return factorial(a) * factorial(b) * factorial(c) / factorial(a + b + c + 3);
}

double line_moment(int a) { return a % 2 == 0 ? 2.0 / (a + 1.0) : 0.0; }

double integrate(const QuadratureRule& rule, int a, int b, int c) {
  double sum = 0.0;
  for (Eigen::Index i = 0; i < rule.weights.size(); ++i) {
    sum += rule.weights[i] * std::pow(rule.points(i, 0), a) * std::pow(rule.points(i, 1), b) *
           std::pow(rule.points(i, 2), c);
  }
  return sum;
}

// Calls f for every a + b + c ≤ degree.
void for_monomials(int degree, const std::function<void(int, int, int)>& f) {
  for (int a = 0; a <= degree; ++a) {
    for (int b = 0; a + b <= degree; ++b) {
      for (int c = 0; a + b + c <= degree; ++c) f(a, b, c);
    }
  }
}

TEST(Quadrature, TetrahedronRulesIntegrateEveryMonomialOfTheirDegree) {
  for (int degree = 0; degree <= 9; ++degree) {
    const QuadratureRule rule = tetrahedron_rule(degree);
    EXPECT_GT(rule.weights.minCoeff(), 0.0);
    for_monomials(degree, [&](int a, int b, int c) {
      EXPECT_NEAR(integrate(rule, a, b, c), tetrahedron_moment(a, b, c), rounding) << degree;
    });
  }
}

TEST(Quadrature, RulesOfFewPointsAreNoBetterThanTheySay) {
  EXPECT_GT(std::abs(integrate(tetrahedron_rule(2), 3, 0, 0) - tetrahedron_moment(3, 0, 0)), 1e-5);
  EXPECT_GT(std::abs(integrate(tetrahedron_rule(5), 6, 0, 0) - tetrahedron_moment(6, 0, 0)), 1e-6);
}

TEST(Quadrature, HexahedronRulesIntegrateEveryDirectionToTwiceTheirPoints) {
  for (int n = 1; n <= 5; ++n) {
    const QuadratureRule rule = hexahedron_rule(n);
    for_monomials(2 * n - 1, [&](int a, int b, int c) {
      const double exact = line_moment(a) * line_moment(b) * line_moment(c);
      EXPECT_NEAR(integrate(rule, a, b, c), exact, 8.0 * rounding) << n;
    });
    const int top = 2 * n - 1;
    EXPECT_NEAR(integrate(rule, top - 1, top - 1, top - 1), std::pow(line_moment(top - 1), 3),
                8.0 * rounding);
  }
}

double triangle_moment(int a, int b) { return factorial(a) * factorial(b) / factorial(a + b + 2); }

TEST(Quadrature, WedgeRulesIntegrateTheirDegreeOverTriangleAndHeight) {
  for (int degree = 0; degree <= 8; ++degree) {
    for (int n = 1; n <= 5; ++n) {
      const QuadratureRule rule = wedge_rule(degree, n);
      EXPECT_GT(rule.weights.minCoeff(), 0.0);
      for (int a = 0; a <= degree; ++a) {
        for (int b = 0; a + b <= degree; ++b) {
          for (int c = 0; c < 2 * n; ++c) {
            EXPECT_NEAR(integrate(rule, a, b, c), triangle_moment(a, b) * line_moment(c), rounding)
                << degree << n;
          }
        }
      }
    }
  }
}

// ∫ ξ^a η^b ζ^c = m_a m_b ∫ (1 − ζ)^(a + b + 2) ζ^c dζ over the pyramid.
TEST(Quadrature, PyramidRulesIntegrateTwiceTheirPoints) {
  for (int n = 1; n <= 5; ++n) {
    const QuadratureRule rule = pyramid_rule(n);
    EXPECT_GT(rule.weights.minCoeff(), 0.0);
    EXPECT_LT(rule.points.col(2).maxCoeff(), 1.0) << "no point at the apex";
    for_monomials(2 * n - 1, [&](int a, int b, int c) {
      const double height = factorial(a + b + 2) * factorial(c) / factorial(a + b + c + 3);
      EXPECT_NEAR(integrate(rule, a, b, c), line_moment(a) * line_moment(b) * height, rounding)
          << n;
    });
  }
}

TEST(Quadrature, FaceRulesIntegrateTheirDegree) {
  for (int degree = 0; degree <= 9; ++degree) {
    const QuadratureRule triangle = face_rule(mesh::FaceType::tri6, degree);
    const QuadratureRule square = face_rule(mesh::FaceType::quad8, degree);
    for (int a = 0; a <= degree; ++a) {
      for (int b = 0; a + b <= degree; ++b) {
        EXPECT_NEAR(integrate(triangle, a, b, 0), triangle_moment(a, b), rounding);
        EXPECT_NEAR(integrate(square, a, b, 0), line_moment(a) * line_moment(b), 4.0 * rounding);
      }
    }
  }
}

}  // namespace
}  // namespace microslip::fem::test_quadrature
