#include "pipelines/scene/bar_modes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <stdexcept>

namespace microslip::pipelines::test_bar_modes {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double pi = std::numbers::pi;

std::vector<int> first(int n) {
  std::vector<int> numbers(static_cast<std::size_t>(n));
  std::iota(numbers.begin(), numbers.end(), 1);
  return numbers;
}

/// The bar of share/scenes/bar_*.toml, on a spring of κ = βL/(EA).
Bar bar_on(double kappa) { return {2e11, 1e-4, 7800.0, 1.03, kappa * 2e11 * 1e-4 / 1.03}; }

TEST(BarModes, TheRootSolvesItsEquationToRounding) {
  for (const double kappa : {1e-12, 1e-3, 0.5, 4.2, 1e3, 1e12}) {
    for (const int number : {1, 2, 10, 1000}) {
      const double z = bar_root(kappa, number);
      const double low = (number - 1) * pi;
      EXPECT_GE(z, low);
      EXPECT_LE(z, low + 0.5 * pi);
      // The function changes its sign within two units in the last place of the root.
      const auto g = [&](double x) { return x * std::sin(x - low) - kappa * std::cos(x - low); };
      const double ulp = 2.0 * z * std::numeric_limits<double>::epsilon();
      EXPECT_LE(g(z - ulp), 0.0) << kappa << ' ' << number;
      EXPECT_GE(g(z + ulp), 0.0) << kappa << ' ' << number;
    }
  }
}

TEST(BarModes, ClampedAndFreeAreLimitsOfTheSpring) {
  for (const int number : {1, 2, 7}) {
    EXPECT_EQ(bar_root(infinity, number), (number - 1) * pi + 0.5 * pi);
    EXPECT_EQ(bar_root(0.0, number), (number - 1) * pi);
    // z = π/2 + kπ − z/κ + O(1/κ²) and z tan z = κ: the next order is below 1e-10 for κ = 1e8.
    EXPECT_NEAR(bar_root(1e8, number), bar_root(infinity, number) * (1.0 - 1e-8), 1e-10);
  }
  EXPECT_NEAR(bar_root(1e-10, 1), 1e-5, 1e-15);  // z² = κ to first order
}

TEST(BarModes, AFreeBarHasARigidBodyMode) {
  const Bar bar = bar_on(0.0);
  const BarModes modes = bar_modes(bar, {1});
  EXPECT_EQ(modes.frequency[0], 0.0);
  const double mass = bar.density * bar.area * bar.length;
  EXPECT_DOUBLE_EQ(modes.amplitude[0], 1.0 / std::sqrt(mass));
}

TEST(BarModes, FrequenciesNearThoseOfThePaper) {
  const Eigen::VectorXd hz = bar_modes(bar_on(4.2), {1, 2}).frequency / (2.0 * pi);
  EXPECT_NEAR(hz[0], 1000.0, 10.0);  // "around the first mode" at 1000 Hz,
  EXPECT_NEAR(hz[1], 3100.0, 15.0);  // the second at 3100 Hz
}

/// ∫ρA φ_m φ_n dx by the rule of Simpson on n cells.
Eigen::MatrixXd mass_matrix(const Bar& bar, const BarModes& modes, Eigen::Index n) {
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(2 * n + 1, 0.0, bar.length);
  Eigen::VectorXd weight = Eigen::VectorXd::Constant(2 * n + 1, 2.0);
  for (Eigen::Index i = 1; i < weight.size(); i += 2) weight[i] = 4.0;
  weight[0] = weight[2 * n] = 1.0;
  weight *= bar.length / (6.0 * static_cast<double>(n));
  const Eigen::MatrixXd shapes = bar_shapes(bar, modes, x);
  return bar.density * bar.area * shapes.transpose() * weight.asDiagonal() * shapes;
}

TEST(BarModes, ModesAreOrthonormal) {
  for (const double kappa : {0.0, 0.1, 4.2, infinity}) {
    const Bar bar = bar_on(kappa);
    const Eigen::MatrixXd mass = mass_matrix(bar, bar_modes(bar, first(10)), 4000);
    // Simpson errs by (z h/L)⁴/180 of the integrand, z ≤ 60 for products, h/L = 1/8000: 2e-11.
    EXPECT_LT((mass - Eigen::MatrixXd::Identity(10, 10)).cwiseAbs().maxCoeff(), 1e-10) << kappa;
  }
}

TEST(BarModes, ShapesMeetBothEnds) {
  const Bar bar = bar_on(4.2);
  const BarModes modes = bar_modes(bar, first(5));
  const double h = 1e-6 * bar.length;
  const Eigen::Vector4d x(0.0, h, bar.length - h, bar.length);
  const Eigen::MatrixXd shapes = bar_shapes(bar, modes, x);
  for (Eigen::Index n = 0; n < 5; ++n) {
    const double scale = modes.amplitude[n] * (1.0 + modes.root[n] * modes.root[n]) / bar.length;
    // One-sided differences err by h φ″/2: 1e-6 of the scale z² c/L.
    const double slope_left = (shapes(1, n) - shapes(0, n)) / h;
    const double slope_right = (shapes(3, n) - shapes(2, n)) / h;
    EXPECT_NEAR(slope_left, 4.2 / bar.length * shapes(0, n), 2e-6 * scale * bar.length);
    EXPECT_NEAR(slope_right, 0.0, 2e-6 * scale * bar.length);
    EXPECT_DOUBLE_EQ(shapes(3, n), modes.amplitude[n]);
  }
}

TEST(BarModes, ResidualFlexibilityIsTheSumOverTheOtherModes) {
  for (const double kappa : {0.3, 4.2, infinity}) {
    const Bar bar = bar_on(kappa);
    const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(9, 0.0, bar.length);
    const Eigen::VectorXd c = bar_residual_flexibility(bar, bar_modes(bar, first(3)), x);
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(x.size());
    for (int number = 4; number <= 1000; ++number) {
      const BarModes one = bar_modes(bar, {number});
      const double integral = one.amplitude[0] * bar.length * std::sin(one.root[0]) / one.root[0];
      sum += bar_shapes(bar, one, x) * (integral / std::pow(one.frequency[0], 2));
    }
    // Terms fall as 2 L²/(EA z³); beyond 1000 they sum to less than L²/(EA) · 1000⁻²/π³ = 4e-8 of
    // L²/(EA).
    const double scale = bar.length * bar.length / (bar.youngs_modulus * bar.area);
    EXPECT_LT((c - sum).cwiseAbs().maxCoeff(), 4e-8 * scale) << kappa;
    EXPECT_GT(c.cwiseAbs().maxCoeff(), 1e-4 * scale);
  }
}

TEST(BarModes, AFreeBarNeedsItsRigidBodyModeForAResidual) {
  const Bar bar = bar_on(0.0);
  const Eigen::Vector3d x(0.1, 0.5, 0.9);
  EXPECT_EQ(bar_residual_flexibility(bar, bar_modes(bar, {1, 2}), x), Eigen::VectorXd::Zero(3));
  EXPECT_THROW(static_cast<void>(bar_residual_flexibility(bar, bar_modes(bar, {2}), x)),
               std::invalid_argument);
}

}  // namespace
}  // namespace microslip::pipelines::test_bar_modes
