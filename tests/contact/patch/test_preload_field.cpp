#include "contact/patch/preload_field.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <string>

#include <Eigen/Core>

namespace microslip::contact::test_preload_field {
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
  const Eigen::VectorXd n = uniform_rest_load(rule.weights, 600.0);
  EXPECT_NEAR(n[5], 600.0 / 3e-4, 1e-8);
  EXPECT_THROW((void)uniform_rest_load(Eigen::VectorXd::Zero(3), 1.0), std::invalid_argument);
}

// Row 21. Hard: a pressure that is negative in places: the total is not the integral.
// Met in: measured and computed pressure fields.
// Right: the pressed part carries the total; without a positive mean it is refused.
TEST(PreloadField, AShapeIsScaledToTheTotalItCarries) {
  const PatchRule rule = l_shape();
  const Eigen::VectorXd shape = (200.0 * rule.p.array()).sin() + 0.2;  // partly a gap
  EXPECT_LT(shape.minCoeff(), 0.0);
  const Eigen::VectorXd n = scaled_rest_load(shape, rule.weights, 750.0);
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
  EXPECT_NE(refusal([&] { return scaled_rest_load(rule.p, rule.weights, 750.0); }).find("above 0"),
            std::string::npos);
  for (const double mean : {-0.5, -2.0}) {  // partly pressing, a gap everywhere
    const Eigen::VectorXd shape = rule.p.array() + mean;
    const std::string said = refusal([&] { return scaled_rest_load(shape, rule.weights, 750.0); });
    EXPECT_NE(said.find("above 0"), std::string::npos) << said;
    EXPECT_NE(said.find(mean < -1.0 ? "to -8 over" : "to -2 over"), std::string::npos) << said;
  }
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(rule.p.size());
  EXPECT_THROW((void)scaled_rest_load(ones, rule.weights, -1.0), std::invalid_argument);
  EXPECT_TRUE(scaled_rest_load(ones, rule.weights, 0.0).isZero(0.0));
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

}  // namespace
}  // namespace microslip::contact::test_preload_field
