#include "contact/patch/preload_field.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>

#include <Eigen/Core>

namespace microslip::contact {
namespace {

struct PatchRule {
  Eigen::VectorXd p, r, weights;  // [m], [m], [m²]
};

/// n × n equal cells of a square, one point in the middle of each.
PatchRule square(double p_begin, double r_begin, double side, Eigen::Index n) {
  const auto cells = static_cast<double>(n);
  PatchRule rule{Eigen::VectorXd(n * n), Eigen::VectorXd(n * n),
                 Eigen::VectorXd::Constant(n * n, side * side / (cells * cells))};
  for (Eigen::Index i = 0; i < n * n; ++i) {
    rule.p[i] = p_begin + side * (static_cast<double>(i % n) + 0.5) / cells;
    rule.r[i] = r_begin + side * (static_cast<double>(i / n) + 0.5) / cells;
  }
  return rule;
}

/// Three squares of a centimetre, nine cells in each.
PatchRule l_shape() {
  constexpr double side = 0.01;
  const PatchRule a = square(0.0, 0.0, side, 3);
  const PatchRule b = square(side, 0.0, side, 3);
  const PatchRule c = square(0.0, side, side, 3);
  PatchRule rule{Eigen::VectorXd(27), Eigen::VectorXd(27), Eigen::VectorXd(27)};
  rule.p << a.p, b.p, c.p;
  rule.r << a.r, b.r, c.r;
  rule.weights << a.weights, b.weights, c.weights;
  return rule;
}

template <typename Call>
std::string refusal(const Call& call) {
  try {
    (void)call();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "not refused";
}

TEST(PreloadField, UniformPressureIsForceOverArea) {
  const PatchRule rule = l_shape();
  const Eigen::VectorXd n = uniform_preload(rule.weights, 600.0);
  EXPECT_NEAR(n[5], 600.0 / 3e-4, 1e-8);
  EXPECT_THROW((void)uniform_preload(Eigen::VectorXd::Zero(3), 1.0), std::invalid_argument);
}

// Any force and moments, about any origin: sums of 27 points, a few roundings of the largest term.
TEST(PreloadField, LinearPressureHasTheResultantsAskedFor) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  for (int k = 0; k < 100; ++k) {
    PatchRule rule = l_shape();
    rule.p.array() += 0.02 * normal(random);
    rule.r.array() += 0.02 * normal(random);
    const PreloadResultants asked{1000.0 * normal(random), normal(random), normal(random)};
    const Eigen::VectorXd n = linear_preload(rule.p, rule.r, rule.weights, asked);
    const PreloadResultants got = resultants(rule.p, rule.r, rule.weights, n);
    const double size = rule.weights.dot(n.cwiseAbs());
    EXPECT_NEAR(got.force, asked.force, 1e-14 * size);
    EXPECT_NEAR(got.moment_about_p, asked.moment_about_p, 1e-14 * size * 0.1);
    EXPECT_NEAR(got.moment_about_r, asked.moment_about_r, 1e-14 * size * 0.1);
  }
}

// Theory section 12: n × m cells, F/(nm) + M_y z/Σz² − M_z y/Σy² with (y, z) = (r, p).
TEST(PreloadField, IsTheFormulaOfTheContactAreaOnAGrid) {
  const PatchRule rule = square(-0.05, -0.05, 0.1, 4);
  const double My = 1.0;
  const double Mz = -0.4;
  const Eigen::VectorXd n = linear_preload(
      rule.p, rule.r, rule.weights, {.force = 48.0, .moment_about_p = Mz, .moment_about_r = My});
  for (Eigen::Index i = 0; i < rule.p.size(); ++i) {
    const double cell =
        48.0 / 16.0 + My * rule.p[i] / rule.p.squaredNorm() - Mz * rule.r[i] / rule.r.squaredNorm();
    EXPECT_NEAR(n[i] * rule.weights[i], cell, 1e-13 * 48.0);
  }
}

TEST(PreloadField, PointsOnALineCarryWhatTheyCan) {
  const Eigen::VectorXd p = Eigen::VectorXd::LinSpaced(5, -1.0, 1.0);
  const Eigen::VectorXd r = Eigen::VectorXd::Zero(5);
  const Eigen::VectorXd w = Eigen::VectorXd::Ones(5);
  const Eigen::VectorXd n = linear_preload(p, r, w, {10.0, 0.0, 2.0});
  EXPECT_NEAR(resultants(p, r, w, n).moment_about_r, 2.0, 1e-14);
  EXPECT_NE(refusal([&] {
              return linear_preload(p, r, w, {10.0, 0.5, 2.0});
            }).find("lie on a line"),
            std::string::npos);
  const Eigen::VectorXd one = Eigen::VectorXd::Ones(1);
  EXPECT_NEAR(linear_preload(one, one, one, {10.0, -10.0, 10.0})[0], 10.0, 1e-14);
  EXPECT_THROW((void)linear_preload(one, one, one, {10.0, 0.0, 0.0}), std::invalid_argument);
}

TEST(PreloadField, AShapeIsScaledToTheTotalItCarries) {
  const PatchRule rule = l_shape();
  const Eigen::VectorXd shape = (200.0 * rule.p.array()).sin() + 0.2;  // partly a gap
  EXPECT_LT(shape.minCoeff(), 0.0);
  const Eigen::VectorXd n = scaled_preload(shape, rule.weights, 750.0);
  EXPECT_NEAR(rule.weights.dot(n.cwiseMax(0.0)), 750.0, 1e-11);
  EXPECT_NEAR(carried_force(n, rule.weights), 750.0, 1e-11);
  EXPECT_LT(rule.weights.dot(n), 740.0);  // the gap counts against it in the plain integral
  EXPECT_NO_THROW(require_total(n, rule.weights, 750.0, 1e-12));
  EXPECT_LT((n / n[0] - shape / shape[0]).norm(), 1e-12);
}

// Hard case 21: without a mean; and a shape that scaling alone would turn round, gaps into
// pressure.
TEST(PreloadField, AShapeWithoutPositiveMeanIsNotScaled) {
  const PatchRule rule = square(-1.0, -1.0, 2.0, 4);
  EXPECT_NE(refusal([&] { return scaled_preload(rule.p, rule.weights, 750.0); }).find("above 0"),
            std::string::npos);
  for (const double mean : {-0.5, -2.0}) {  // partly pressing, a gap everywhere
    const Eigen::VectorXd shape = rule.p.array() + mean;
    const std::string said = refusal([&] { return scaled_preload(shape, rule.weights, 750.0); });
    EXPECT_NE(said.find("above 0"), std::string::npos) << said;
    EXPECT_NE(said.find(mean < -1.0 ? "to -8 over" : "to -2 over"), std::string::npos) << said;
  }
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(rule.p.size());
  EXPECT_THROW((void)scaled_preload(ones, rule.weights, -1.0), std::invalid_argument);
  EXPECT_TRUE(scaled_preload(ones, rule.weights, 0.0).isZero(0.0));
}

TEST(PreloadField, AWrongTotalIsRefusedWithBothNumbers) {
  const Eigen::VectorXd w = Eigen::VectorXd::Constant(4, 0.25);
  const std::string said = refusal([&] {
    require_total(Eigen::VectorXd::Constant(4, 950.0), w, 1000.0, 1e-3);
    return 0;
  });
  EXPECT_NE(said.find("950 N"), std::string::npos) << said;
  EXPECT_NE(said.find("1000 N"), std::string::npos) << said;
  Eigen::VectorXd broken = Eigen::VectorXd::Ones(4);
  broken[2] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(require_total(broken, w, 1.0, 1.0), std::invalid_argument);
  EXPECT_THROW(require_total(Eigen::VectorXd::Ones(3), w, 1.0, 1.0), std::invalid_argument);
}

TEST(PreloadField, AGapIsNegativePressure) {
  const Eigen::Vector2d gap(1e-6, 0.0);
  const Eigen::Vector2d stiffness(1e12, 2e12);
  EXPECT_EQ(preload_of_gap(gap, stiffness), Eigen::VectorXd(Eigen::Vector2d(-1e6, 0.0)));
}

}  // namespace
}  // namespace microslip::contact
