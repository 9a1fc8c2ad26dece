#include "solver/branch/refit.hpp"

#include <algorithm>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "contact/force/fitted_patch_force.hpp"
#include "contact/force/patch_force.hpp"
#include "solver/continuation.hpp"
#include "solver/peak/local_peak.hpp"
#include "tests/support/curves.hpp"

namespace microslip::solver {
namespace {

using contact::FittedPatchForce;
using contact::ModalForce;
using contact::ModalShapes;
using contact::PatchCells;
using contact::PointParameters;
using tests::marked;

ModalShapes shapes_at(const Eigen::VectorXd& p, const Eigen::VectorXd& r) {
  ModalShapes shapes{Eigen::MatrixXd(p.size(), 2), Eigen::MatrixXd(p.size(), 2), {}};
  shapes.u << (1.0 + p.array() * r.array()).matrix(), p.array().cos().matrix();
  shapes.v << (0.5 + 0.3 * r.array()).matrix(), (0.2 * p.array().square()).matrix();
  return shapes;
}

contact::ParameterField parameters_at(double preload) {
  return [preload](const Eigen::VectorXd& p, const Eigen::VectorXd& r) {
    std::vector<PointParameters> points;
    for (Eigen::Index i = 0; i < p.size(); ++i) {
      points.push_back({800.0, 1200.0, 0.4, preload * (1.0 + 0.5 * p[i] - 0.3 * r[i])});
    }
    return points;
  };
}

PatchCells patch(int n_p, int n_r) {
  return contact::rectangle_cells({0.0, 0.0}, {1.0, 0.5}, n_p, n_r);
}

std::unique_ptr<ModalForce> on_cells(double preload, int n_p, int n_r) {
  const contact::PatchRule rule = contact::midpoint_rule(patch(n_p, n_r));
  return std::make_unique<contact::PatchForce>(
      contact::ContactPatch(rule.weights, parameters_at(preload)(rule.p, rule.r)),
      shapes_at(rule.p, rule.r));
}

std::unique_ptr<FittedPatchForce> on_lines(double preload,
                                           const contact::FittedPatchOptions& options) {
  return std::make_unique<FittedPatchForce>(patch(1, 1), shapes_at, parameters_at(preload),
                                            options);
}

Scene scene_with(std::unique_ptr<ModalForce> force) {
  Scene scene;
  scene.natural_frequency = Eigen::Vector2d(20.0, 55.0);
  scene.damping_ratio = Eigen::Vector2d(0.01, 0.01);
  scene.excitation = Harmonics(1, 2);
  scene.excitation.rows().row(1) << 10.0, 4.0;
  scene.output = Eigen::Vector2d(1.0, 0.5);
  scene.contact = std::move(force);
  return scene;
}

ContinuationOptions range() {
  ContinuationOptions options;
  options.frequency_begin = 12.0;
  options.frequency_end = 45.0;
  return options;
}

/// A curve on fitted forces, with the scene as it left it.
struct Traced {
  Scene scene;
  ResponseCurve curve;
};

/// Traced once for all tests of a preload: the result does not depend on who asks first.
const Traced& traced(double preload) {
  static std::map<double, Traced> known;
  auto found = known.find(preload);
  if (found == known.end()) {
    Scene scene = scene_with(on_lines(preload, {}));
    ResponseCurve curve = trace_response(scene, range());
    found = known.emplace(preload, Traced{std::move(scene), std::move(curve)}).first;
  }
  return found->second;
}

// A gap that opens and closes, a curve with two folds, and microslip.
class Refits : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Preloads, Refits, testing::Values(-20.0, 60.0, 200.0));

TEST_P(Refits, CurveMeetsThatOfManyCells) {
  const ResponseCurve& fitted = traced(GetParam()).curve;
  const ResponseCurve cells = trace_response(scene_with(on_cells(GetParam(), 40, 20)), range());
  ASSERT_TRUE(fitted.complete) << fitted.message;
  ASSERT_TRUE(cells.complete) << cells.message;
  for (const PointMark mark : {PointMark::peak, PointMark::fold}) {
    const auto expected = marked(cells, mark);
    const auto found = marked(fitted, mark);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      // 800 midpoint cells err by up to 2.2e-5 at these peaks, 51200 by up to 5e-7. At a fold,
      // where the branch is vertical, amplitudes go like the root of what moves the frequency.
      EXPECT_NEAR(found[i].frequency, expected[i].frequency, 4e-5 * expected[i].frequency);
      if (mark == PointMark::fold) continue;
      EXPECT_NEAR(found[i].amplitude, expected[i].amplitude, 4e-5 * expected[i].amplitude);
    }
  }
}

TEST_P(Refits, EveryPointSolvesTheEquationsOnAForceFittedToItAlone) {
  const ResponseCurve& curve = traced(GetParam()).curve;
  ASSERT_TRUE(curve.complete) << curve.message;
  for (std::size_t i = 0; i < curve.points.size(); i += 3) {
    const ResponsePoint& point = curve.points[i];
    const Scene fresh =
        scene_with(on_lines(GetParam(), {.rule = {.order = 12}, .force_tolerance = 1e-12}));
    const HarmonicBalance balance(fresh, HarmonicSet(1));
    const Eigen::VectorXd x = balance.unknowns(point.q);
    fresh.contact->begin_point();
    static_cast<void>(refit_to(balance, {{x, point.frequency}}));
    const BalanceEvaluation here = balance.evaluate(x, point.frequency);
    // The tolerance of a refit is 1e-6 of the contact force.
    const double stuck = (point.q.rows() * balance.stuck_stiffness()).norm();
    EXPECT_LE(here.residual.norm(), 3e-6 * std::max(here.contact_force.norm(), stuck))
        << point.frequency;
    EXPECT_LE(point.quadrature_change, 1e-6) << point.frequency;
  }
}

TEST_P(Refits, SingleFrequencyAgreesWithTheCurveThere) {
  const Scene scene = scene_with(on_lines(GetParam(), {}));
  const double frequency = 17.0;
  const ResponseCurve alone = solve_at_frequency(scene, frequency, range());
  ASSERT_EQ(alone.points.size(), 1U);
  const ResponseCurve& curve = traced(GetParam()).curve;
  const auto there = points_at_frequency(scene, curve, frequency, range());
  ASSERT_FALSE(there.empty());
  double nearest = 1.0;
  for (const ResponsePoint& point : there) {
    nearest = std::min(nearest, std::abs(point.amplitude / alone.points[0].amplitude - 1.0));
  }
  EXPECT_LT(nearest, 1e-5);
}

TEST(Refit, PeakIsFollowedToAnotherPreload) {
  const Scene& from = traced(60.0).scene;
  const auto peaks = marked(traced(60.0).curve, PointMark::peak);
  ASSERT_FALSE(peaks.empty());
  const HarmonicBalance balance(from, HarmonicSet(1));
  const auto here = local_peak(balance, peaks.front());
  ASSERT_TRUE(here);
  const Scene to = scene_with(on_lines(63.0, {}));
  const HarmonicBalance other(to, HarmonicSet(1));
  PeakWork work;
  const auto there = follow_peak(other, *here, here->point, range(), work);
  ASSERT_TRUE(there);
  ContinuationOptions around = range();  // the peak, with room to spare
  around.frequency_begin = 0.9 * there->point.parameter;
  around.frequency_end = 1.1 * there->point.parameter;
  const auto expected =
      marked(trace_response(scene_with(on_lines(63.0, {})), around), PointMark::peak);
  ASSERT_FALSE(expected.empty());
  // Two rules within 1e-6 of the force of the true one; a peak answers a few times as much.
  EXPECT_NEAR(there->amplitude, expected.front().amplitude, 1e-5 * expected.front().amplitude);
}

/// A force that asks for one more solution and then can no longer be solved.
class Spoiled final : public ModalForce {
 public:
  [[nodiscard]] Eigen::Index n_modes() const override { return 1; }
  [[nodiscard]] contact::ForceAndJacobian evaluate(const Harmonics& q, double) const override {
    const Eigen::VectorXd x = q.vector();
    contact::ForceAndJacobian result{q, Eigen::MatrixXd::Zero(3, 3), Eigen::VectorXd::Zero(3)};
    result.force.rows().setConstant(spoiled_ ? 1e3 + x.norm() : 0.0);
    return result;
  }
  [[nodiscard]] contact::CycleReport report(const Harmonics&, double) const override { return {}; }
  [[nodiscard]] Eigen::MatrixXd stuck_stiffness() const override {
    return Eigen::MatrixXd::Ones(1, 1);
  }
  [[nodiscard]] contact::Refit refit(const std::vector<contact::Motion>&) override {
    spoiled_ = true;
    return {contact::Refit::Outcome::replaced, 0.5, 1};
  }
  void undo_refit() override { spoiled_ = false; }

 private:
  bool spoiled_ = false;
};

TEST(Refit, GoesBackWhereTheNewForceHasNoSolution) {
  Scene scene;
  scene.natural_frequency = Eigen::VectorXd::Constant(1, 1.0);
  scene.damping_ratio = Eigen::VectorXd::Constant(1, 0.1);
  scene.excitation = Harmonics(1, 1);
  scene.excitation.rows()(1, 0) = 1.0;
  scene.output = Eigen::VectorXd::Ones(1);
  scene.contact = std::make_unique<Spoiled>();
  const ResponseCurve curve = solve_at_frequency(scene, 0.5, {});
  ASSERT_EQ(curve.points.size(), 1U);
  ASSERT_EQ(curve.log.size(), 1U);
  EXPECT_EQ(curve.log[0].remedy, "quadrature-kept");
  EXPECT_EQ(curve.points[0].quadrature_change, 0.5);
  EXPECT_LT(curve.points[0].residual, 1e-10);
}

}  // namespace
}  // namespace microslip::solver
