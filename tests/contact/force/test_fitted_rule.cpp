#include "contact/force/fitted_rule.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

namespace microslip::contact {
namespace {

using Function = std::function<double(double, double)>;

Guards guards_of(const std::vector<Function>& functions) {
  Guards guards;
  guards.lines.resize(functions.size());
  guards.values = [functions](const Eigen::VectorXd& p, const Eigen::VectorXd& r) {
    Eigen::MatrixXd values(p.size(), static_cast<Eigen::Index>(functions.size()));
    for (Eigen::Index i = 0; i < p.size(); ++i) {
      for (std::size_t k = 0; k < functions.size(); ++k) {
        values(i, static_cast<Eigen::Index>(k)) = functions[k](p[i], r[i]);
      }
    }
    return values;
  };
  return guards;
}

template <typename F>
double integral(const PatchRule& rule, const F& f) {
  double sum = 0.0;
  for (Eigen::Index i = 0; i < rule.n_points(); ++i) {
    sum += rule.weights[i] * f(rule.p[i], rule.r[i]);
  }
  return sum;
}

double area_above(const PatchRule& rule, const Function& guard) {
  return integral(rule, [&](double p, double r) { return guard(p, r) > 0.0 ? 1.0 : 0.0; });
}

Function circle(double p0, double r0, double radius) {
  return [=](double p, double r) {
    return radius * radius - (p - p0) * (p - p0) - (r - r0) * (r - r0);
  };
}

PatchCells unit_square(int n) { return rectangle_cells({0, 0}, {1, 1}, n, n); }

constexpr double pi = std::numbers::pi;

TEST(FittedRule, WithoutLinesIsGauss) {
  const PatchRule fitted =
      fitted_rule(unit_square(2), guards_of({[](double, double) { return 1.0; }}), {.order = 5});
  const PatchRule gauss = gauss_rule(unit_square(2), 5);
  EXPECT_EQ(fitted.p, gauss.p);
  EXPECT_EQ(fitted.r, gauss.r);
  EXPECT_LE((fitted.weights - gauss.weights).cwiseAbs().maxCoeff(), 1e-17);
  EXPECT_EQ(fitted_rule(unit_square(2), {{}, {}}, {.order = 5}).n_points(), 100);
}

struct AreaCase {
  const char* name;
  int n_cells;
  Function guard;
  double area;  // where the guard is positive, on the unit square
};

class FittedArea : public testing::TestWithParam<AreaCase> {};

// Hard case 23: every way a line can lie in a cell.
TEST_P(FittedArea, IsRightToTheLineTolerance) {
  const AreaCase& c = GetParam();
  for (const int order : {2, 5, 8}) {
    const PatchRule rule =
        fitted_rule(unit_square(c.n_cells), guards_of({c.guard}), {.order = order});
    EXPECT_NEAR(rule.weights.sum(), 1.0, 1e-12);
    EXPECT_NEAR(area_above(rule, c.guard), c.area, 1e-10) << "order " << order;
    EXPECT_GT(rule.weights.minCoeff(), 0.0);
  }
}

// Area of the circle segment cut off at distance d from the centre.
double segment(double radius, double d) {
  return radius * radius * std::acos(d / radius) - d * std::sqrt(radius * radius - d * d);
}

INSTANTIATE_TEST_SUITE_P(
    Lines, FittedArea,
    testing::Values(
        AreaCase{"straight", 1, [](double p, double r) { return r - 0.3 - 0.2 * p; }, 0.6},
        AreaCase{"upright", 1, [](double p, double) { return p - 0.3; }, 0.7},
        AreaCase{"nearly upright", 1, [](double p, double r) { return p - 0.3 + 1e-9 * r; },
                 0.7 + 0.5e-9},
        AreaCase{"on an edge", 2, [](double p, double) { return p - 0.5; }, 0.5},
        AreaCase{"on the outer edge", 2, [](double p, double) { return p; }, 1.0},
        AreaCase{"diagonal through nodes", 3, [](double p, double r) { return p - r; }, 0.5},
        AreaCase{"through a node", 2, [](double p, double r) { return p - 0.5 + 0.3 * (r - 0.5); },
                 0.5},
        AreaCase{"corner cut", 1, [](double p, double r) { return p + r - 1.9; }, 0.005},
        AreaCase{"tiny corner", 1, [](double p, double r) { return p + r - 2.0 + 1e-4; }, 0.5e-8},
        AreaCase{"parabola", 2, [](double p, double r) { return r - p * p; }, 2.0 / 3.0},
        AreaCase{"sine", 2,
                 [](double p, double r) { return r - 0.5 - 0.4 * std::sin(2.0 * pi * p); }, 0.5},
        AreaCase{"loop", 1, circle(0.45, 0.55, 0.3), 0.09 * pi},
        AreaCase{"small loop", 1, circle(0.43, 0.51, 0.01), 1e-4 * pi},
        AreaCase{"loop over nodes", 3, circle(0.5, 0.5, 0.41), 0.1681 * pi},
        AreaCase{"loop tangent to four edges", 1, circle(0.5, 0.5, 0.5), 0.25 * pi},
        AreaCase{"loop tangent to inner edges", 2, circle(0.25, 0.25, 0.25), 0.0625 * pi},
        AreaCase{"loop beyond an edge", 1, circle(0.2, 0.5, 0.25),
                 0.0625 * pi - segment(0.25, 0.2)},
        AreaCase{"loop barely beyond an edge", 1, circle(0.25 - 1e-6, 0.5, 0.25),
                 0.0625 * pi - segment(0.25, 0.25 - 1e-6)},
        AreaCase{"loop barely inside an edge", 1, circle(0.25 + 1e-6, 0.5, 0.25), 0.0625 * pi},
        AreaCase{"tangent from outside", 1, circle(1.2, 0.5, 0.2), 0.0},
        AreaCase{"two branches that cross", 1,
                 [](double p, double r) { return (r - p) * (r + p - 1.0); }, 0.5},
        AreaCase{"four strips", 1,
                 [](double p, double r) { return std::cos(4.0 * pi * (r - 0.1 * p)); }, 0.5}),
    [](const auto& test) {
      std::string name = test.param.name;
      std::ranges::replace(name, ' ', '_');
      return name;
    });

// Lines of several guards in one cell: where both are positive is a lens.
TEST(FittedRule, SplitsAlongLinesOfSeveralGuardsThatCross) {
  const Function a = circle(0.4, 0.5, 0.3);
  const Function b = circle(0.6, 0.5, 0.3);
  const PatchRule rule = fitted_rule(unit_square(1), guards_of({a, b}), {});
  const double lens = integral(
      rule, [&](double p, double r) { return a(p, r) > 0.0 && b(p, r) > 0.0 ? 1.0 : 0.0; });
  EXPECT_NEAR(rule.weights.sum(), 1.0, 1e-12);
  EXPECT_NEAR(lens, 2.0 * segment(0.3, 0.1), 1e-10);
}

TEST(FittedRule, TakesLinesThatCoincideAsOne) {
  const auto line = [](double p, double r) { return r - 0.3 - 0.1 * p * p; };
  const auto same = [&](double p, double r) { return (2.0 + p) * line(p, r); };
  const PatchRule one = fitted_rule(unit_square(1), guards_of({line}), {});
  const PatchRule two = fitted_rule(unit_square(1), guards_of({line, same}), {});
  EXPECT_NEAR(area_above(two, line), 0.7 - 0.1 / 3.0, 1e-10);
  EXPECT_EQ(two.n_points(), one.n_points());
}

// Four concentric loops and a straight line through all of them.
TEST(FittedRule, HandlesManyLinesInOneCell) {
  std::vector<Function> functions{[](double p, double r) { return p + 0.3 * r - 0.6; }};
  for (const double radius : {0.1, 0.2, 0.3, 0.4}) {
    functions.push_back(circle(0.5, 0.5, radius));
  }
  const PatchRule rule = fitted_rule(unit_square(1), guards_of(functions), {});
  EXPECT_NEAR(rule.weights.sum(), 1.0, 1e-12);
  EXPECT_NEAR(area_above(rule, functions[0]), 1.0 - 0.45, 1e-10);
  for (int i = 1; i <= 4; ++i) {
    EXPECT_NEAR(area_above(rule, functions[static_cast<std::size_t>(i)]), 0.01 * i * i * pi, 1e-10);
  }
}

TEST(FittedRule, IgnoresALineOutsideItsDomain) {
  const auto line = [](double, double r) { return r - 0.5; };
  const auto domain = [](double p, double) { return p - 0.25; };
  Guards guards = guards_of({line, domain});
  guards.lines[0] = {.domain = 1, .domain_sign = -1};
  const PatchRule rule = fitted_rule(unit_square(1), guards, {.order = 4});
  // Four pieces without the domain; the part beyond p = 1/4 stays whole.
  EXPECT_EQ(rule.n_points(), 3 * 16);
  const double kinked = integral(
      rule, [&](double p, double r) { return domain(p, r) < 0.0 ? std::abs(line(p, r)) : 1.0; });
  EXPECT_NEAR(kinked, 0.25 * 0.25 + 0.75, 1e-14);
}

// A kink and a root on the positive side of a curved line: exponential in the order.
TEST(FittedRule, ConvergesExponentiallyForRootsOfTheGuard) {
  const Function guard = [](double p, double r) { return r - 0.3 - 0.3 * p * p; };
  const auto f = [&](double p, double r) {
    return (1.0 + p * r) * std::pow(std::max(guard(p, r), 0.0), 1.5) + p;
  };
  const double exact = [] {
    // ∫₀¹ [ (1 + p y₀) z^2.5/2.5 + p z^3.5/3.5 ] dp + ½, z = 0.7 − 0.3p², y₀ = 1 − z
    const PatchRule line = gauss_rule(rectangle_cells({0, 0}, {1, 1}, 1, 1), 40);
    return 0.5 + integral(line, [](double p, double) {
             const double z = 0.7 - 0.3 * p * p;
             return (1.0 + p * (1.0 - z)) * std::pow(z, 2.5) / 2.5 + p * std::pow(z, 3.5) / 3.5;
           });
  }();
  Guards guards = guards_of({guard});
  guards.lines[0].is_graded = true;
  EXPECT_NEAR(integral(fitted_rule(unit_square(1), guards, {.order = 4}), f), exact, 1e-5);
  EXPECT_NEAR(integral(fitted_rule(unit_square(1), guards, {.order = 6}), f), exact, 1e-8);
  EXPECT_NEAR(integral(fitted_rule(unit_square(1), guards, {.order = 9}), f), exact, 1e-12);
}

// Hard case 18: an annulus of bent cells and a triangle, with a line across all of them.
TEST(FittedRule, WorksOnHolesAndTriangles) {
  const int n = 12;
  PatchCells cells{Eigen::MatrixX2d(2 * n, 2), Eigen::MatrixX4i(n + 1, 4)};
  for (int i = 0; i < n; ++i) {
    const double angle = 2.0 * pi * i / n;
    cells.vertices.row(2 * i) << std::cos(angle), std::sin(angle);
    cells.vertices.row(2 * i + 1) << 2.0 * std::cos(angle), 2.0 * std::sin(angle);
    cells.corners.row(i) << 2 * i, 2 * i + 1, (2 * i + 3) % (2 * n), (2 * i + 2) % (2 * n);
  }
  cells.corners.row(n) << 0, 8, 16, -1;  // inside the hole
  const double ring = 3.0 * 0.5 * n * std::sin(2.0 * pi / n);
  const double triangle = 0.75 * std::sqrt(3.0);
  const Function guard = [](double p, double r) { return r * (1.0 + 0.1 * p * p); };
  const PatchRule rule = fitted_rule(cells, guards_of({guard}), {.order = 3});
  EXPECT_NEAR(rule.weights.sum(), ring + triangle, 1e-12);
  EXPECT_NEAR(area_above(rule, guard), 0.5 * (ring + triangle), 1e-10);
}

// Random smooth lines, each against a rule that is finer in every respect and against counting
// cells.
TEST(FittedRule, FindsEveryPieceOfRandomLines) {
  std::mt19937_64 random(11);
  std::normal_distribution<double> normal;
  const PatchRule count = midpoint_rule(unit_square(300));
  for (int k = 0; k < 20; ++k) {
    std::array<double, 8> c{};
    for (double& x : c) {
      x = normal(random);
    }
    const Function guard = [c](double p, double r) {
      return c[0] + std::sin(c[1] + 6.0 * c[2] * p) + c[3] * std::cos(c[4] + 6.0 * c[5] * r) +
             c[6] * p * r + c[7] * p;
    };
    const Guards guards = guards_of({guard});
    const PatchRule rule = fitted_rule(unit_square(1), guards, {.order = 5});
    const PatchRule finer =
        fitted_rule(unit_square(2), guards, {.order = 10, .line_tolerance = 1e-12});
    EXPECT_NEAR(rule.weights.sum(), 1.0, 1e-12);
    EXPECT_NEAR(area_above(rule, guard), area_above(finer, guard), 1.1e-10) << k;
    // Cells on a line count wholly or not: a few hundred of 90 000, at random.
    EXPECT_NEAR(area_above(rule, guard), area_above(count, guard), 2e-3) << k;
  }
}

// Guards that are not smooth (a jump, a cone) and lines that are not (a cusp) are split to the last
// depth and no further.
TEST(FittedRule, EndsWhereGuardsAreNotSmooth) {
  const auto jump = [](double p, double) { return p < 0.3 ? -1.0 : 2.0; };
  const auto cone = [](double p, double r) { return std::hypot(p - 0.5, r - 0.5) - 1e-3; };
  const auto cusp = [](double p, double r) { return p * p * p - (r - 0.5) * (r - 0.5); };
  for (const Function& guard : {Function(jump), Function(cone), Function(cusp)}) {
    const PatchRule rule =
        fitted_rule(unit_square(1), guards_of({guard}), {.order = 3, .max_depth = 5});
    EXPECT_NEAR(rule.weights.sum(), 1.0, 1e-12);
    EXPECT_LT(rule.n_points(), 40000);
  }
}

TEST(FittedRule, RefusesBrokenOptionsAndGuards) {
  const Guards guards = guards_of({circle(0.5, 0.5, 0.2)});
  EXPECT_THROW((void)fitted_rule(unit_square(1), guards, {.order = 0}), std::invalid_argument);
  EXPECT_THROW((void)fitted_rule(unit_square(1), guards, {.line_tolerance = 0.0}),
               std::invalid_argument);
  EXPECT_THROW((void)fitted_rule(unit_square(1), guards, {.max_depth = -1}), std::invalid_argument);
  Guards two = guards;
  two.lines.resize(2);
  EXPECT_THROW((void)fitted_rule(unit_square(1), two, {}), std::invalid_argument);
  const Guards broken =
      guards_of({[](double, double) { return std::numeric_limits<double>::quiet_NaN(); }});
  EXPECT_THROW((void)fitted_rule(unit_square(1), broken, {}), std::invalid_argument);
}

}  // namespace
}  // namespace microslip::contact
