#include "contact/plane/planar_slip.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "contact/bracketed_root.hpp"

namespace microslip::contact::test_planar_slip {
namespace {

TEST(RadauNodes, IntegrateAndDifferentiatePolynomialsExactly) {
  const RadauNodes& rule = radau_nodes();
  for (int degree = 0; degree <= 8; ++degree) {
    double sum = 0.0;
    for (std::size_t i = 0; i < n_stages; ++i) {
      sum += rule.weight[i] * std::pow(rule.node[i], degree);
    }
    EXPECT_NEAR(sum, 1.0 / (degree + 1), 1e-15) << degree;  // ten roundings of 1
  }
  for (int i = 0; i < n_stages; ++i) {
    double slope = 0.0;
    for (int j = 1; j <= n_stages; ++j) {
      slope += rule.derivative(i, j) * std::pow(rule.node[static_cast<std::size_t>(j - 1)], 5);
    }
    EXPECT_NEAR(slope, 5.0 * std::pow(rule.node[static_cast<std::size_t>(i)], 4), 1e-13);
  }
}

// (I + λK)⁻¹ f* on the circle of the radius; for equal stiffness the radial return.
TEST(ReturnedForce, LiesOnTheCircleAndOpposesTheSlipOfTheSlider) {
  const Eigen::Vector2d trial(3.0, -2.0);
  EXPECT_EQ(returned_force(trial, {1.0, 0.2}, 4.0), trial);
  const Eigen::Vector2d stiffness(1.0, 0.2);
  const Eigen::Vector2d force = returned_force(trial, stiffness, 0.7);
  EXPECT_NEAR(force.norm(), 0.7, 1e-15);
  // The slider moves by K⁻¹ (f* − f), along f.
  const Eigen::Vector2d moved = (trial - force).cwiseQuotient(stiffness);
  EXPECT_NEAR(moved[0] * force[1] - moved[1] * force[0], 0.0, 1e-13);
  EXPECT_GT(moved.dot(force), 0.0);
  EXPECT_LT((returned_force(trial, {1.0, 1.0}, 0.7) - 0.7 * trial.normalized()).norm(), 1e-15);
}

// Circular motion, started on its steady circle: the error of one step falls with the length to the
// ninth power or faster.
TEST(SlipStep, ConvergesWithItsOrder) {
  const SurfaceLaw law({1.0, 0.0, 0.5, 1.0}, 1.0);
  Harmonics motion(1, 3);
  motion.rows()(2, 0) = 1.0;
  motion.rows()(1, 2) = 1.0;
  const PlanarMotion planar(law, motion, 1.0);
  const double lead = std::acos(0.5);
  const auto exact = [&](double phase) -> Eigen::Vector2d {
    const Eigen::Vector2d force(0.5 * std::cos(phase + lead), 0.5 * std::sin(phase + lead));
    return (Eigen::Vector2d(std::cos(phase), std::sin(phase)) - force) / planar.length_scale();
  };
  double error[2] = {};
  for (int i = 0; i < 2; ++i) {
    SlipStep step;
    step.length = i == 0 ? 1.2 : 0.6;
    step.slider = exact(0.0);
    EXPECT_TRUE(solve_slip(planar, 0.0, step));
    error[i] = (step.end_slider() - exact(step.length)).norm();
  }
  EXPECT_LT(error[0], 1e-6);
  EXPECT_GT(error[0] / error[1], 256.0);
}

TEST(BracketedRoot, FindsTheSignChangeToRounding) {
  const auto f = [](double x) { return std::cos(x) - x; };
  const double root = bracketed_root(f, 0.0, 1.0, f(0.0), f(1.0));
  EXPECT_NEAR(root, 0.7390851332151607, 2e-16);
  const auto flat = [](double x) { return std::pow(x - 0.3, 7); };
  EXPECT_NEAR(bracketed_root(flat, 0.0, 1.0, flat(0.0), flat(1.0)), 0.3, 1e-12);
}

}  // namespace
}  // namespace microslip::contact::test_planar_slip
