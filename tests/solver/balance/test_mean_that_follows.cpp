// Contact that does not answer the mean: the balance without its mean against the whole one.

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "contact/force/patch_force.hpp"
#include "contact/force/point_method_force.hpp"
#include "contact/force/vibration_alone.hpp"
#include "contact/line/line_events.hpp"
#include "solver/balance/harmonic_balance.hpp"
#include "solver/continuation.hpp"
#include "solver/peak/high_points.hpp"
#include "solver/stability/stability.hpp"
#include "tests/support/curves.hpp"

namespace microslip::solver::test_mean_that_follows {
namespace {

using contact::ModalForce;

/// The same force, the mean an unknown all the same.
class MeanKept final : public ModalForce {
 public:
  explicit MeanKept(std::unique_ptr<ModalForce> force)
      : ModalForce(force->n_modes()), force_(std::move(force)) {}
  [[nodiscard]] std::unique_ptr<Workspace> workspace() const override {
    return force_->workspace();
  }
  [[nodiscard]] contact::CycleReport report(const Harmonics& q, double frequency,
                                            Workspace& work) const override {
    return force_->report(q, frequency, work);
  }
  [[nodiscard]] double work_error(const Harmonics& q, double frequency,
                                  Workspace& work) const override {
    return force_->work_error(q, frequency, work);
  }
  void states(const Harmonics& q, double frequency, contact::ContactStates& result,
              Workspace& work) const override {
    force_->states(q, frequency, result, work);
  }
  [[nodiscard]] Eigen::MatrixXd stuck_stiffness() const override {
    return force_->stuck_stiffness();
  }
  [[nodiscard]] contact::LinearState linear_state_of(
      const contact::MotionSet& motions) const override {
    return force_->linear_state_of(motions);
  }

 private:
  [[nodiscard]] contact::ForceAndJacobian evaluated(const Harmonics& q, double frequency,
                                                    const contact::Asked& asked,
                                                    Workspace& work) const override {
    return force_->evaluate(q, frequency, asked, work);
  }

  std::unique_ptr<ModalForce> force_;
};

constexpr Eigen::Index n_modes = 2;
/// Points that slip and open.
const std::vector<contact::PointParameters> points{{0.5, 0.4, 0.4, 0.6}, {0.3, 0.6, 0.3, 0.9}};

contact::ModalShapes shapes() {
  contact::ModalShapes s{Eigen::MatrixXd(2, n_modes), Eigen::MatrixXd(2, n_modes), {}};
  s.u << 1.0, 0.4, 0.7, -0.6;
  s.v << 0.5, -0.3, 0.2, 0.8;
  return s;
}

const Eigen::Vector2d weights(1.0, 0.5);

std::unique_ptr<ModalForce> in_closed_form() {
  return std::make_unique<contact::PatchForce>(contact::ContactPatch(weights, points), shapes());
}

std::unique_ptr<ModalForce> by_events() {
  std::vector<std::shared_ptr<const contact::PointMethod>> methods;
  for (const contact::PointParameters& point : points) {
    methods.push_back(std::make_shared<contact::LineEvents>(point));
  }
  return std::make_unique<contact::PointMethodForce>(weights, std::move(methods), shapes());
}

/// Modes at 1 and 2.4 rad/s, a load beside the one that is harmonic.
Scene scene_of(std::unique_ptr<ModalForce> force, bool is_kept) {
  Scene scene;
  scene.natural_frequency = Eigen::Vector2d(1.0, 2.4);
  scene.damping_ratio = Eigen::Vector2d(0.02, 0.02);
  scene.excitation = Harmonics(1, n_modes);
  scene.excitation.rows() << 0.3, -0.4, 0.2, 0.5, 0.0, 0.3;
  scene.output = Eigen::Vector2d(1.0, 0.7);
  auto alone = std::make_unique<contact::VibrationAlone>(std::move(force));
  if (is_kept) {
    scene.contact = std::make_unique<MeanKept>(std::move(alone));
  } else {
    scene.contact = std::move(alone);
  }
  return scene;
}

/// Of the balance at a solution; −∞ where nothing is slow.
double slow_growth(const Scene& scene, const ResponsePoint& point) {
  HarmonicBalance balance(scene, HarmonicSet(point.orders));
  const BalanceEvaluation at = balance.evaluate(balance.unknowns(point.q), point.frequency);
  const double growth = slow_flow_stability(balance, at.jacobian, point.frequency).growth;
  return std::max(growth, -1e3);
}

struct Case {
  std::string name;
  std::function<std::unique_ptr<ModalForce>()> make;
  ContinuationOptions options;
};

std::vector<Case> cases() {
  Case one{"one harmonic", in_closed_form, tests::frequency_range(0.5, 3.0)};
  one.options.linear_certificate = false;
  Case several{"several", by_events, one.options};
  several.options.n_harmonics = 4;
  Case chosen{"chosen", by_events, one.options};
  chosen.options.harmonic_tolerance = 0.01;
  chosen.options.n_harmonics = 9;
  return {one, several, chosen};
}

TEST(MeanThatFollows, IsNoUnknown) {
  const Scene follows = scene_of(by_events(), false);
  const Scene kept = scene_of(by_events(), true);
  HarmonicBalance lean(follows, HarmonicSet(3));
  HarmonicBalance whole(kept, HarmonicSet(3));
  EXPECT_EQ(lean.size() + n_modes, whole.size());
  // Of any vibration the mean that the balance of means asks for.
  Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(whole.size(), -2.0, 3.0);
  const Eigen::VectorXd without = x.tail(lean.size());
  const BalanceEvaluation at = lean.evaluate(without, 0.9);
  x.head(n_modes) = at.mean;
  const BalanceEvaluation all = whole.evaluate(x, 0.9);
  EXPECT_LT(all.residual.head(n_modes).norm(), 1e-14 * all.contact_force.norm());
  EXPECT_LT((all.residual.tail(lean.size()) - at.residual).norm(), 1e-14 * at.residual.norm());
  EXPECT_EQ(lean.motion(without, at).vector(), x);
  EXPECT_EQ(lean.residual(without, 0.9).mean, at.mean);
  EXPECT_GT(at.mean.norm(), 0.1);
}

TEST(MeanThatFollows, GivesTheCurveOfTheWholeBalance) {
  for (const Case& one : cases()) {
    SCOPED_TRACE(one.name);
    const Scene follows = scene_of(one.make(), false);
    const Scene kept = scene_of(one.make(), true);
    const auto lean = high_points(follows, trace_response(follows, one.options), one.options);
    const auto whole = high_points(kept, trace_response(kept, one.options), one.options);
    ASSERT_EQ(lean.size(), whole.size());
    ASSERT_FALSE(lean.empty());
    for (std::size_t i = 0; i < lean.size(); ++i) {
      const ResponsePoint& a = lean[i].point;
      const ResponsePoint& b = whole[i].point;
      EXPECT_NEAR(a.frequency, b.frequency, 1e-9 * b.frequency);
      EXPECT_NEAR(a.amplitude, b.amplitude, 1e-9 * b.amplitude);
      EXPECT_EQ(a.orders, b.orders);
    }
  }
}

TEST(MeanThatFollows, GivesMeanProofAndStabilityOfTheWholeBalance) {
  for (const Case& one : cases()) {
    const Scene follows = scene_of(one.make(), false);
    const Scene kept = scene_of(one.make(), true);
    for (const double frequency : {0.6, 1.0, 1.1, 2.0, 2.5}) {
      SCOPED_TRACE(one.name + " at " + std::to_string(frequency));
      ContinuationOptions there = one.options;
      there.frequency_begin = there.frequency_end = frequency;
      const ResponseCurve lean = trace_response(follows, there);
      const ResponseCurve whole = trace_response(kept, there);
      ASSERT_TRUE(lean.complete && whole.complete) << lean.message << whole.message;
      const ResponsePoint& a = lean.points.front();
      const ResponsePoint& b = whole.points.front();
      EXPECT_LT((a.q.rows() - b.q.rows()).norm(), 1e-9 * b.q.rows().norm());
      EXPECT_NEAR(a.mean, b.mean, 1e-9 * b.amplitude);
      EXPECT_NEAR(a.report.slip_work, b.report.slip_work, 1e-9);
      EXPECT_EQ(a.stability, b.stability);
      EXPECT_EQ(a.determinant_sign, b.determinant_sign);
      // Hill's exponents of the mean alone say nothing: b may be judged by them.
      EXPECT_NE(a.stability_basis, StabilityBasis::hill);
      EXPECT_NEAR(slow_growth(follows, a), slow_growth(kept, b), 1e-9);
    }
  }
}

TEST(MeanThatFollows, IsThatOfTheVibrationWhereContactIsProvedLinear) {
  const Scene scene = scene_of(by_events(), false);
  ContinuationOptions proved = tests::frequency_range(0.1, 0.1);
  ContinuationOptions solved = proved;
  solved.linear_certificate = false;
  const ResponseCurve linear = trace_response(scene, proved);
  ASSERT_NE(linear.certificate, "");
  const Eigen::Vector2d mean = linear.points.front().q.mean().transpose();
  EXPECT_LT((mean - trace_response(scene, solved).points.front().q.mean().transpose()).norm(),
            1e-13);
  EXPECT_LT((mean - Eigen::Vector2d(0.3, -0.4 / 5.76)).norm(), 1e-13);  // Q_b / ω_n²
}

}  // namespace
}  // namespace microslip::solver::test_mean_that_follows
