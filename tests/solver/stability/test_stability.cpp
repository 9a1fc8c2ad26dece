#include "solver/stability/stability.hpp"

#include <cmath>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>

#include "contact/transient/patch_transient.hpp"
#include "contact/transient/planar_transient.hpp"
#include "contact/trigonometric_basis.hpp"
#include "solver/balance/linear_force.hpp"
#include "solver/continuation.hpp"
#include "tests/solver/duffing.hpp"
#include "tests/support/full_force.hpp"
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
    scene.contact = std::make_unique<LinearForce>(stiffness, contact::CycleReport{});
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

TEST(Stability, OfAMotionThatSticksThroughoutIsProvedWithoutEigenvaluesOrIntegration) {
  ContinuationOptions options;
  options.n_harmonics = 3;
  const auto basis_at = [&](double preload, bool in_time = true) {
    Scene scene = tests::three_dof_scene(preload);
    if (in_time) tests::add_transient(scene);
    tests::use_event_cycles(scene);
    const auto curve = solve_at_frequency(scene, 2.0 * std::numbers::pi * 20.5, options);
    EXPECT_TRUE(curve.complete);
    return curve.points.at(0).stability_basis;
  };
  EXPECT_EQ(basis_at(30.0), StabilityBasis::damped_linear);
  EXPECT_EQ(basis_at(3.0), StabilityBasis::period_map);
  EXPECT_EQ(basis_at(30.0, false), StabilityBasis::damped_linear);
  EXPECT_EQ(basis_at(3.0, false), StabilityBasis::hill);
}

// Row 34. Hard: damping below 0: a solution exists and nothing goes to it.
// Met in: the project's list of hard cases.
// Right: unstable.
TEST(Stability, NegativeDampingIsUnstable) {
  tests::Duffing linear;
  linear.alpha = 0.0;
  linear.zeta = -0.01;
  const auto curve = solve_at_frequency(linear.scene(), 0.9, {});
  ASSERT_TRUE(curve.complete);
  EXPECT_EQ(curve.points[0].stability, Stability::unstable);
}

/// α q³ on any harmonics, by samples; exact for those kept.
class SampledCubicSpring final : public tests::FullForce {
 public:
  explicit SampledCubicSpring(double alpha) : FullForce(1), alpha_(alpha) {}
  [[nodiscard]] Eigen::MatrixXd stuck_stiffness() const override {
    return Eigen::MatrixXd::Zero(1, 1);
  }
  [[nodiscard]] contact::CycleReport report(const contact::Harmonics& /*q*/, double /*frequency*/,
                                            Workspace& /*work*/) const override {
    return {};
  }
  [[nodiscard]] contact::ForceAndJacobian by_all(const contact::Harmonics& q,
                                                 double /*frequency*/) const override {
    constexpr int n_samples = 128;
    const Eigen::Index size = q.vector().size();
    contact::ForceAndJacobian result;
    result.force = contact::Harmonics(q.n_harmonics(), 1);
    result.jacobian = Eigen::MatrixXd::Zero(size, size);
    result.frequency_derivative = Eigen::VectorXd::Zero(size);
    Eigen::VectorXd basis(size);
    for (int i = 0; i < n_samples; ++i) {
      contact::trigonometric_basis(q.n_harmonics(), 2.0 * std::numbers::pi * i / n_samples, basis);
      const double x = basis.dot(q.vector());
      Eigen::VectorXd projection = basis * (2.0 / n_samples);
      projection[0] *= 0.5;
      result.force.vector() += alpha_ * x * x * x * projection;
      result.jacobian += 3.0 * alpha_ * x * x * projection * basis.transpose();
    }
    return result;
  }

 private:
  double alpha_;
};

/// Largest growth [rad/s] of perturbations of a motion of one mode on a cubic spring: δ̈ + 2ζδ̇ +
/// (1 + 3αq²)δ = 0 over a period by Runge and Kutta's method.
double growth_in_time(const tests::Duffing& duffing, const ResponsePoint& at) {
  constexpr int n_steps = 4000;
  const double period = 2.0 * std::numbers::pi / at.frequency;
  const double h = period / n_steps;
  Eigen::VectorXd basis(at.q.vector().size());
  const auto rate = [&](double time, const Eigen::Matrix2d& y) {
    contact::trigonometric_basis(at.q.n_harmonics(), at.frequency * time, basis);
    const double q = basis.dot(at.q.vector());
    const Eigen::Matrix2d a{{0.0, 1.0}, {-1.0 - 3.0 * duffing.alpha * q * q, -2.0 * duffing.zeta}};
    return Eigen::Matrix2d(a * y);
  };
  Eigen::Matrix2d y = Eigen::Matrix2d::Identity();
  for (int i = 0; i < n_steps; ++i) {
    const Eigen::Matrix2d k1 = rate(i * h, y);
    const Eigen::Matrix2d k2 = rate((i + 0.5) * h, y + 0.5 * h * k1);
    const Eigen::Matrix2d k3 = rate((i + 0.5) * h, y + 0.5 * h * k2);
    const Eigen::Matrix2d k4 = rate((i + 1) * h, y + h * k3);
    y += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
  }
  return std::log(y.eigenvalues().cwiseAbs().maxCoeff()) / period;
}

TEST(Stability, OfAnOddMotionEachExponentIsTakenOnce) {
  // Beside its folds both exponents are real; shifted by the frequency to even perturbations each
  // stands there twice, as a conjugate pair.
  const tests::Duffing duffing;
  Scene scene = duffing.scene();
  scene.contact = std::make_unique<SampledCubicSpring>(duffing.alpha);
  ContinuationOptions options;
  options.frequency_begin = 0.7;
  options.frequency_end = 2.5;
  options.n_harmonics = 11;
  options.orders = {1, 3, 5, 7, 9, 11};
  options.without_mean = true;
  const ResponseCurve curve = trace_response(scene, options);
  ASSERT_TRUE(curve.complete) << curve.message;
  HarmonicBalance balance(scene, HarmonicSet(options.orders, HarmonicSet::Mean::left_out));
  int n_beside = 0;
  for (const ResponsePoint& point : curve.points) {
    if (point.mark == PointMark::fold) continue;
    const auto at = balance.evaluate(balance.unknowns(point.q), point.frequency);
    const auto slow = slow_flow_stability(balance, at.jacobian, point.frequency);
    const auto hill = hill_growth(balance, point.q, point.frequency, *slow.reduced);
    ASSERT_TRUE(hill.has_value());
    const double growth = growth_in_time(duffing, point);
    EXPECT_NEAR(hill->largest, growth, 1e-4) << point.frequency << ' ' << point.amplitude;
    n_beside += std::abs(growth + duffing.zeta) > 1e-3 ? 1 : 0;
  }
  EXPECT_GE(n_beside, 10);
}

}  // namespace
}  // namespace microslip::solver::test_stability
