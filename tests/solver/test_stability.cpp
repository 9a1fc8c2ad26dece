#include "solver/stability.hpp"

#include <cmath>
#include <memory>

#include <gtest/gtest.h>

#include "solver/continuation.hpp"
#include "tests/support/modal_scenes.hpp"

namespace microslip::solver {
namespace {

ContinuationOptions chain_range() {
  ContinuationOptions options;
  options.frequency_begin = 2.0 * M_PI * 18.0;
  options.frequency_end = 2.0 * M_PI * 28.0;
  return options;
}

TEST(Stability, OfThreeCoexistingMotionsTheMiddleOneIsUnstable) {
  for (const double preload : {25.0, 30.0, 50.0}) {
    const Scene scene = tests::three_dof_scene(preload);
    const ResponseCurve curve = trace_response(scene, chain_range());
    double low = 1e9;
    double high = 0.0;
    for (const ResponsePoint& point : curve.points) {
      if (point.mark != PointMark::fold) continue;
      low = std::min(low, point.frequency);
      high = std::max(high, point.frequency);
    }
    ASSERT_LT(low, high) << preload;
    const double omega = 0.5 * (low + high);
    const auto points = points_at_frequency(scene, curve, omega, chain_range());
    ASSERT_EQ(points.size(), 3U) << preload;
    const HarmonicBalance balance(scene, 1);
    for (std::size_t i = 0; i < 3; ++i) {
      const auto at = balance.evaluate(points[i].q.vector(), omega);
      const StabilityReport report = assess_stability(balance, at.jacobian, omega);
      // The determinant and the growth of the slow flow judge alike, each on its own.
      EXPECT_EQ(report.determinant_sign, i == 1 ? -1.0 : 1.0) << preload << ' ' << i;
      EXPECT_EQ(report.growth > 0.0, i == 1) << preload << ' ' << i;
      EXPECT_EQ(report.stability, i == 1 ? Stability::unstable : Stability::stable);
    }
  }
}

TEST(Stability, SlowFlowOfALinearModeDecaysWithItsDamping) {
  tests::Duffing linear;
  linear.gamma = 0.0;
  const Scene scene = linear.scene();
  const HarmonicBalance balance(scene, 1);
  // Ä is left out: λ = −ζω₀ ± i(ω₀ − ω) up to terms of second order in both.
  const double omega = 1.01;
  const Eigen::VectorXd x = balance.linear_response(omega, Eigen::MatrixXd::Zero(1, 1));
  const StabilityReport report =
      assess_stability(balance, balance.evaluate(x, omega).jacobian, omega);
  EXPECT_EQ(report.stability, Stability::stable);
  EXPECT_NEAR(report.growth, -0.02, 5e-4);
  EXPECT_NEAR(report.nearest, std::hypot(0.02, 0.01), 5e-4);
}

TEST(Stability, NegativeDampingIsUnstable) {
  tests::Duffing linear;
  linear.gamma = 0.0;
  linear.damping_ratio = -0.01;
  const Scene scene = linear.scene();
  const ResponseCurve curve = solve_at_frequency(scene, 0.9, {});
  ASSERT_TRUE(curve.complete);
  EXPECT_EQ(curve.points[0].stability, Stability::unstable);
}

}  // namespace
}  // namespace microslip::solver
