// Steps that end before too much of the contact has changed its state.

#include "solver/branch/step_states.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "solver/balance/linear_force.hpp"
#include "solver/continuation.hpp"
#include "tests/support/asked_force.hpp"
#include "tests/support/random_scene.hpp"
#include "tests/support/readable_patch.hpp"

namespace microslip::solver::test_step_states {
namespace {

contact::ContactStates states_at(const Scene& scene, const ResponsePoint& point) {
  return tests::states(*scene.contact, point.q, point.frequency);
}

/// A mode on 200 soft points that begin to slip at amplitudes from 9.99 to 10.01:
/// the branch hardly turns there.
Scene soft_patch() {
  tests::SinglePoint single;
  Scene scene = tests::single_point_scene(single);
  constexpr Eigen::Index n = 200;
  std::vector<contact::PointParameters> points;
  for (Eigen::Index i = 0; i < n; ++i) {
    const double onset = 9.99 + 0.02 * (static_cast<double>(i) + 0.5) / n;
    points.push_back({0.002, 0.0, 0.5, 0.002 * onset / 0.5});
  }
  scene.contact = std::make_unique<tests::ReadablePatch>(
      contact::ContactPatch(Eigen::VectorXd::Constant(n, 1.0 / n), std::move(points)),
      contact::ModalShapes{Eigen::MatrixXd::Ones(n, 1), Eigen::MatrixXd::Zero(n, 1), {}});
  return scene;
}

TEST(StepStates, NoStepChangesMoreThanAFifthOfAPatch) {
  const Scene scene = soft_patch();
  ContinuationOptions options;
  options.frequency_begin = 0.7;
  options.frequency_end = 1.4;
  const ResponseCurve curve = trace_response(scene, options);
  EXPECT_TRUE(curve.complete) << curve.message;
  EXPECT_TRUE(curve.log.empty());
  double largest = 0.0;
  for (std::size_t i = 1; i < curve.points.size(); ++i) {
    const contact::StateChange change = contact::state_change(states_at(scene, curve.points[i - 1]),
                                                              states_at(scene, curve.points[i]));
    largest = std::max(largest, change.share);
  }
  EXPECT_LE(largest, 0.2);
  EXPECT_GT(largest, 0.1);  // and there is something to limit
}

TEST(StepStates, OnePointIsFollowedToWhereItBeginsToSlip) {
  // Constant load: slip begins at the amplitude μ n₀ / k_u exactly. The spring is too soft for the
  // branch to turn there.
  tests::SinglePoint single;
  single.point = {0.001, 0.0, 0.5, 0.02};
  const double onset = 0.5 * 0.02 / 0.001;
  const Scene scene = tests::single_point_scene(single);
  for (const auto& [begin, end] : {std::pair{0.7, 1.4}, std::pair{1.4, 0.7}}) {
    ContinuationOptions options;
    options.frequency_begin = begin;
    options.frequency_end = end;
    const ResponseCurve curve = trace_response(scene, options);
    ASSERT_TRUE(curve.complete) << curve.message;
    int n_changes = 0;
    for (std::size_t i = 1; i < curve.points.size(); ++i) {
      const double before = curve.points[i - 1].amplitude;
      const double after = curve.points[i].amplitude;
      if ((before > onset) == (after > onset)) continue;
      ++n_changes;
      // Just beyond: a fiftieth of the step, which is a fifth of the amplitude at the most.
      EXPECT_NEAR(after, onset, 0.005 * onset);
    }
    EXPECT_EQ(n_changes, 2);  // to and fro
    EXPECT_GE(curve.state_cuts, 2);
    EXPECT_GT(curve.state_readings, 0);
  }
}

/// Points that change their state with every change of the frequency; the force is linear.
class Chatter final : public contact::ModalForce {
 public:
  explicit Chatter(std::size_t n_points)
      : ModalForce(1),
        linear_(Eigen::MatrixXd::Ones(1, 1), contact::CycleReport{}),
        n_points_(n_points) {}
  [[nodiscard]] Eigen::MatrixXd stuck_stiffness() const override {
    return linear_.stuck_stiffness();
  }
  [[nodiscard]] contact::CycleReport report(const Harmonics& q, double frequency,
                                            Workspace& work) const override {
    return linear_.report(q, frequency, work);
  }
  void states(const Harmonics& /*q*/, double frequency, contact::ContactStates& result,
              Workspace& /*work*/) const override {
    const bool slips = std::remainder(1e9 * frequency, 2.0) > 0.0;
    const double share = 1.0 / static_cast<double>(n_points_);
    const contact::CycleStates stuck{contact::CycleRegime::full_stick, contact::PeriodStates()};
    const contact::CycleStates slipping{
        contact::CycleRegime::stick_slip,
        contact::PeriodStates(contact::ContactState::positive_slip)};
    result.assign(n_points_, {share, slips ? slipping : stuck});
  }

 private:
  [[nodiscard]] contact::ForceAndJacobian evaluated(const Harmonics& q, double frequency,
                                                    const contact::Asked& asked,
                                                    Workspace& work) const override {
    return linear_.evaluate(q, frequency, asked, work);
  }

  LinearForce linear_;
  std::size_t n_points_;
};

Scene chattering(std::size_t n_points) {
  tests::SinglePoint single;
  Scene scene = tests::single_point_scene(single);
  scene.contact = std::make_unique<Chatter>(n_points);
  return scene;
}

TEST(StepStates, ThatChangeAtEveryStepDoNotHoldTheWalkUp) {
  ContinuationOptions options;
  options.frequency_begin = 1.0;
  options.frequency_end = 2.0;
  Scene calm = chattering(1);
  calm.contact = std::make_unique<LinearForce>(Eigen::MatrixXd::Ones(1, 1), contact::CycleReport{});
  const std::size_t n_calm = trace_response(calm, options).points.size();
  for (const std::size_t n_points : {1U, 8U, 20U, 200U}) {
    SCOPED_TRACE(n_points);
    const ResponseCurve curve = trace_response(chattering(n_points), options);
    EXPECT_TRUE(curve.complete) << curve.message;
    EXPECT_GT(curve.state_cuts, 0);
    EXPECT_LT(curve.points.size(), 3 * n_calm);
    const bool at_once = std::any_of(
        curve.log.begin(), curve.log.end(),
        [](const SolverEvent& event) { return event.remedy == Remedy::states_at_once; });
    EXPECT_EQ(at_once, n_points > 8);  // of a handful one at a time is no more than allowed
  }
}

}  // namespace
}  // namespace microslip::solver::test_step_states
