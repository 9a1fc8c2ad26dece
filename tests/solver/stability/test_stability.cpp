#include "solver/stability/stability.hpp"

#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "contact/transient/patch_transient.hpp"
#include "contact/transient/planar_transient.hpp"
#include "solver/balance/linear_force.hpp"
#include "solver/continuation.hpp"
#include "tests/solver/duffing.hpp"
#include "tests/support/modal_scenes.hpp"
#include "tests/support/random_scene.hpp"

namespace microslip::solver::test_stability {
namespace {

TEST(Stability, SlowFlowOfALinearModeDecaysWithItsDamping) {
  tests::Duffing duffing;
  duffing.alpha = 0.0;
  const Scene scene = duffing.scene();
  HarmonicBalance balance(scene, 1);
  const auto at = balance.evaluate(Eigen::VectorXd::Zero(3), 1.0);
  const StabilityReport report =
      assess_stability(balance, at.jacobian, contact::Harmonics(1, 1), 1.0);
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
    HarmonicBalance balance(scene, 1);
    for (const auto& point : trace_response(scene, options).points) {
      if (point.mark == PointMark::fold) continue;  // neutral
      const auto at = balance.evaluate(point.q.vector(), point.frequency);
      const StabilityReport report =
          assess_stability(balance, at.jacobian, point.q, point.frequency);
      EXPECT_EQ(report.growth > 0.0, report.determinant_sign < 0.0) << preload;
    }
  }
}

/// Two modes on a spring between them, three harmonics.
Scene sprung_modes(double damping_ratio) {
  Scene scene;
  scene.natural_frequency = Eigen::Vector2d(1.0, 2.2);
  scene.damping_ratio = Eigen::Vector2d(0.01, damping_ratio);
  scene.output = Eigen::Vector2d(1.0, 0.5);
  scene.excitation = contact::Harmonics(3, 2);
  scene.excitation.rows()(1, 0) = 1.0;
  scene.excitation.rows()(5, 1) = 0.3;
  const Eigen::Matrix2d stiffness{{1.0, 0.4}, {0.4, 0.16}};  // of one spring: singular
  scene.contact = std::make_unique<LinearForce>(stiffness, contact::CycleReport{1.0, 0.0, 0.0});
  return scene;
}

StabilityBasis basis_of(const Scene& scene) {
  ContinuationOptions options;
  options.n_harmonics = 3;
  const auto curve = solve_at_frequency(scene, 0.83, options);
  EXPECT_TRUE(curve.complete);
  if (!curve.complete) return StabilityBasis::hill;
  EXPECT_EQ(curve.points[0].stability, Stability::stable);
  return curve.points[0].stability_basis;
}

TEST(Stability, OfADampedLinearStructureIsProvedForAnyNumberOfHarmonics) {
  EXPECT_EQ(basis_of(sprung_modes(0.02)), StabilityBasis::damped_linear);
  Scene free = sprung_modes(0.02);
  free.contact = nullptr;
  EXPECT_EQ(basis_of(free), StabilityBasis::damped_linear);
}

TEST(Stability, OfALinearStructureWithAnUndampedModeIsNotProved) {
  EXPECT_EQ(basis_of(sprung_modes(0.0)), StabilityBasis::hill);
  Scene free = sprung_modes(0.0);
  free.contact = nullptr;
  EXPECT_EQ(basis_of(free), StabilityBasis::hill);
}

TEST(Stability, OfALinearForceThatIsNoSpringIsNotProved) {
  // A circulatory or a softening force can make a damped structure unstable.
  for (const Eigen::Matrix2d& stiffness :
       {Eigen::Matrix2d{{0.0, 0.01}, {-0.01, 0.0}}, Eigen::Matrix2d{{-0.1, 0.0}, {0.0, 0.0}}}) {
    Scene scene = sprung_modes(0.02);
    scene.contact = std::make_unique<LinearForce>(stiffness, contact::CycleReport{1.0, 0.0, 0.0});
    EXPECT_EQ(basis_of(scene), StabilityBasis::hill);
  }
}

TEST(Stability, OfEveryLinearCurveIsProved) {
  Scene scene = tests::three_dof_scene(1e6);  // sticks: certified
  tests::use_event_cycles(scene);
  ContinuationOptions options;
  options.n_harmonics = 3;
  options.frequency_begin = 2.0 * std::numbers::pi * 18.0;
  options.frequency_end = 2.0 * std::numbers::pi * 28.0;
  for (const auto& curve :
       {trace_response(scene, options), trace_linear(scene, LinearLimit::free, options),
        trace_linear(scene, LinearLimit::stuck, options)}) {
    ASSERT_TRUE(curve.complete) << curve.message;
    for (const auto& point : curve.points) {
      EXPECT_EQ(point.stability, Stability::stable) << point.frequency;
      EXPECT_EQ(point.stability_basis, StabilityBasis::damped_linear) << point.frequency;
    }
  }
}

/// A mode along p that rubs under a constant load, judged with three harmonics at a motion that
/// slips.
StabilityBasis basis_in_time(std::unique_ptr<contact::TransientForce> transient,
                             PeriodMapEffort effort) {
  Scene scene;
  scene.natural_frequency = Eigen::VectorXd::Constant(1, 1.0);
  scene.damping_ratio = Eigen::VectorXd::Constant(1, 0.03);
  scene.output = Eigen::VectorXd::Ones(1);
  scene.excitation = contact::Harmonics(1, 1);
  scene.transient = std::move(transient);
  contact::Harmonics q(3, 1);
  q.rows()(1, 0) = 1.0;
  StabilityReport hill;
  hill.basis = StabilityBasis::hill;
  return stability_in_time(HarmonicBalance(scene, HarmonicSet(3)), q, 0.9, hill, effort).basis;
}

TEST(Stability, IsJudgedInTimeAtEveryPointOnlyWhereAPeriodIsCheap) {
  // Events along a line take 1 ms a period, slip in a plane or under another law 10: nine tenths of
  // a curve.
  const contact::PointParameters point{1.0, 0.0, 0.3, 0.5};
  const Eigen::VectorXd weight = Eigen::VectorXd::Ones(1);
  const Eigen::MatrixXd one = Eigen::MatrixXd::Ones(1, 1);
  const Eigen::MatrixXd none = Eigen::MatrixXd::Zero(1, 1);
  const auto line = [&] {
    return std::make_unique<contact::PatchTransient>(contact::ContactPatch(weight, {point}),
                                                     contact::ModalShapes{one, none, {}});
  };
  const auto plane = [&] {
    return std::make_unique<contact::PlanarTransient>(
        weight, std::vector{contact::SurfaceLaw(point, point.tangential_stiffness)},
        contact::ModalShapes{one, none, {}});
  };
  EXPECT_EQ(basis_in_time(line(), PeriodMapEffort::every_point), StabilityBasis::period_map);
  EXPECT_EQ(basis_in_time(line(), PeriodMapEffort::few_points), StabilityBasis::period_map);
  EXPECT_EQ(basis_in_time(plane(), PeriodMapEffort::every_point), StabilityBasis::hill);
  EXPECT_EQ(basis_in_time(plane(), PeriodMapEffort::few_points), StabilityBasis::period_map);
}

TEST(Stability, OfAMotionThatSticksThroughoutIsProvedWithoutIntegration) {
  ContinuationOptions options;
  options.n_harmonics = 3;
  const auto basis_at = [&](double preload) {
    Scene scene = tests::three_dof_scene(preload);
    tests::add_transient(scene);
    tests::use_event_cycles(scene);
    const auto curve = solve_at_frequency(scene, 2.0 * std::numbers::pi * 20.5, options);
    EXPECT_TRUE(curve.complete);
    return curve.points.at(0).stability_basis;
  };
  EXPECT_EQ(basis_at(30.0), StabilityBasis::damped_linear);
  EXPECT_EQ(basis_at(3.0), StabilityBasis::period_map);
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
}  // namespace microslip::solver::test_stability
