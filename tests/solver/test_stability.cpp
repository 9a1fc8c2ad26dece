#include "solver/stability.hpp"

#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "duffing.hpp"
#include "solver/continuation.hpp"
#include "tests/support/random_scene.hpp"

namespace microslip::solver {
namespace {

TEST(Stability, SlowFlowOfALinearModeDecaysWithItsDamping) {
  tests::Duffing duffing;
  duffing.alpha = 0.0;
  const Scene scene = duffing.scene();
  const HarmonicBalance balance(scene, 1);
  const auto at = balance.evaluate(Eigen::VectorXd::Zero(3), 1.0);
  const StabilityReport report = assess_stability(balance, at.jacobian, 1.0);
  EXPECT_EQ(report.stability, Stability::stable);
  EXPECT_EQ(report.determinant_sign, 1.0);
  // −ζω to the order of the slow flow, which errs by ζ² itself.
  EXPECT_NEAR(report.growth, -duffing.zeta, duffing.zeta * duffing.zeta);
}

TEST(Stability, OfThreeCoexistingSolutionsTheMiddleOneIsUnstable) {
  // Theory section 20.4: 30 N, inside the jump.
  const Scene scene = tests::three_dof_scene(30.0);
  ContinuationOptions options;
  options.frequency_begin = 2.0 * std::numbers::pi * 18.0;
  options.frequency_end = 2.0 * std::numbers::pi * 28.0;
  const auto curve = trace_response(scene, options);
  std::vector<double> folds;
  for (const auto& point : curve.points) {
    if (point.mark == PointMark::fold) folds.push_back(point.frequency);
  }
  ASSERT_GE(folds.size(), 2U);
  const auto points = points_at_frequency(scene, curve, 0.5 * (folds[0] + folds[1]), options);
  ASSERT_EQ(points.size(), 3U);
  EXPECT_EQ(points[0].stability, Stability::stable);
  EXPECT_EQ(points[1].stability, Stability::unstable);
  EXPECT_EQ(points[2].stability, Stability::stable);
  EXPECT_LT(points[1].determinant_sign, 0.0);
}

TEST(Stability, DeterminantAndGrowthJudgeAlike) {
  // Theory section 20.4 at all three preloads that jump: each on its own finds the middle motion
  // unstable.
  ContinuationOptions options;
  options.frequency_begin = 2.0 * std::numbers::pi * 18.0;
  options.frequency_end = 2.0 * std::numbers::pi * 28.0;
  for (const double preload : {25.0, 30.0, 50.0}) {
    const Scene scene = tests::three_dof_scene(preload);
    const HarmonicBalance balance(scene, 1);
    for (const auto& point : trace_response(scene, options).points) {
      if (point.mark == PointMark::fold) continue;  // neutral
      const auto at = balance.evaluate(point.q.vector(), point.frequency);
      const StabilityReport report = assess_stability(balance, at.jacobian, point.frequency);
      EXPECT_EQ(report.growth > 0.0, report.determinant_sign < 0.0) << preload;
    }
  }
}

TEST(Stability, NegativeDampingIsUnstable) {
  tests::Duffing linear;
  linear.alpha = 0.0;
  linear.zeta = -0.01;
  const auto curve = solve_at_frequency(linear.scene(), 0.9, {});
  ASSERT_TRUE(curve.complete);
  EXPECT_EQ(curve.points[0].stability, Stability::unstable);
}

}  // namespace
}  // namespace microslip::solver
