#include "solver/stability/floquet.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdio>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "solver/continuation.hpp"
#include "solver/time_integration.hpp"
#include "tests/support/modal_scenes.hpp"
#include "tests/support/random_scene.hpp"
#include "tests/support/readable_patch.hpp"
#include "tests/support/steady_states.hpp"

namespace microslip::solver::test_floquet {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;
constexpr Eigen::Index most = 40;

/// Theory section 20.4 with 15 N: a curve without folds whose motion parts from period one near
/// 27.6 Hz.
struct Chain {
  explicit Chain(int n_harmonics) : scene(tests::three_dof_scene(15.0)) {
    tests::add_transient(scene);
    tests::use_event_cycles(scene);
    options.frequency_begin = two_pi * 18.0;
    options.frequency_end = two_pi * 28.0;
    options.n_harmonics = n_harmonics;
  }
  [[nodiscard]] ResponsePoint at(double hz) const {
    const auto curve = solve_at_frequency(scene, two_pi * hz, options);
    EXPECT_TRUE(curve.complete);
    return curve.points.at(0);
  }

  Scene scene;
  ContinuationOptions options;
};

/// Factor per period by which two motions, begun 1e-7 apart, part or meet again.
double measured_factor(const TimeSystem& system, const TimeState& from, int n_periods) {
  TimeOptions options;
  options.step_tolerance = 1e-13;
  const auto stepper = make_stepper(system, options);
  TimeState a = from;
  TimeState b = from;
  b.motion.q *= 1.0 + 1e-7;
  double first = 0.0;
  const int warm_up = n_periods / 4;  // what decays faster is gone by then
  for (int i = 0; i < n_periods; ++i) {
    if (i == warm_up) first = std::log((b.motion.q - a.motion.q).norm());
    stepper->advance_period(a, nullptr);
    stepper->advance_period(b, nullptr);
  }
  const double last = std::log((b.motion.q - a.motion.q).norm());
  return std::exp((last - first) / (n_periods - warm_up));
}

/// The same force, of which nothing is said to be linear: the period map is differenced.
class Differenced final : public contact::TransientForce {
 public:
  explicit Differenced(std::unique_ptr<const contact::TransientForce> force)
      : force_(std::move(force)) {}
  [[nodiscard]] Eigen::Index n_modes() const override { return force_->n_modes(); }
  [[nodiscard]] Eigen::Index n_points() const override { return force_->n_points(); }
  [[nodiscard]] contact::TransientMemory virgin_memory() const override {
    return force_->virgin_memory();
  }
  [[nodiscard]] Eigen::VectorXd trial_force(const contact::ModalMotion& motion,
                                            const contact::TransientMemory& memory) const override {
    return force_->trial_force(motion, memory);
  }
  double commit(const contact::ModalMotion& motion,
                contact::TransientMemory& memory) const override {
    return force_->commit(motion, memory);
  }
  [[nodiscard]] Eigen::VectorXd held_force(const contact::ModalMotion& motion,
                                           const contact::TransientMemory& memory) const override {
    return force_->held_force(motion, memory);
  }
  [[nodiscard]] Eigen::Matrix<double, Eigen::Dynamic, guards_per_point> guards(
      const contact::ModalMotion& motion, const contact::TransientMemory& memory,
      const contact::GuardScale& scale) const override {
    return force_->guards(motion, memory, scale);
  }
  [[nodiscard]] Guards guards_of(Eigen::Index point, const contact::ModalMotion& motion,
                                 const contact::TransientMemory& memory,
                                 const contact::GuardScale& scale) const override {
    return force_->guards_of(point, motion, memory, scale);
  }
  void switch_state(Eigen::Index point, const contact::ModalMotion& motion,
                    contact::TransientMemory& memory) const override {
    force_->switch_state(point, motion, memory);
  }
  [[nodiscard]] double slip_power(const contact::ModalMotion& motion,
                                  const contact::TransientMemory& memory) const override {
    return force_->slip_power(motion, memory);
  }
  [[nodiscard]] contact::StateShares shares(const contact::TransientMemory& memory) const override {
    return force_->shares(memory);
  }
  [[nodiscard]] Eigen::MatrixXd stuck_stiffness() const override {
    return force_->stuck_stiffness();
  }

 private:
  std::unique_ptr<const contact::TransientForce> force_;
};

/// Largest distance of a multiplier of one list to the nearest of the other.
double farthest(const Eigen::VectorXcd& a, const Eigen::VectorXcd& b) {
  double distance = 0.0;
  for (const std::complex<double>& value : a) {
    distance = std::max(distance, (b.array() - value).abs().minCoeff());
  }
  return distance;
}

TEST(Floquet, VariationsOfAPeriodAgreeWithItsDifferences) {
  // From gaps through impacts to points that all but stick. Differences of 1e-4 of the motion err
  // by 1e-6, and know nothing where a perturbed period ends in other states.
  int n_compared = 0;
  double worst = 0.0;
  for (const double preload : {-2.0, 0.0, 3.0, 15.0, 25.0, 50.0, 100.0, 200.0}) {
    Scene scene = tests::three_dof_scene(preload);
    tests::add_transient(scene);
    tests::use_event_cycles(scene);
    Scene other = tests::three_dof_scene(preload);
    tests::add_transient(other);
    other.transient = std::make_unique<Differenced>(std::move(other.transient));
    ContinuationOptions options;
    options.n_harmonics = 7;
    for (const double hz : {18.5, 20.5, 22.0, 25.0, 27.8, 33.0}) {
      const ResponseCurve curve = solve_at_frequency(scene, two_pi * hz, options);
      ASSERT_TRUE(curve.complete) << preload << " N, " << hz << " Hz";
      const contact::Harmonics& q = curve.points.at(0).q;
      const auto varied = floquet_multipliers(scene, two_pi * hz, q, most);
      const auto differenced = floquet_multipliers(other, two_pi * hz, q, most);
      // A slider that moves by less than 1e-4 does not move in one of two perturbed periods: no
      // derivative.
      const bool is_told =
          differenced.known() && differenced.multipliers.size() == varied.multipliers.size();
      if (!is_told) continue;
      ++n_compared;
      EXPECT_NEAR(varied.distance, differenced.distance, 1e-6);  // steps of other tolerances
      const double apart = std::max(farthest(varied.multipliers, differenced.multipliers),
                                    farthest(differenced.multipliers, varied.multipliers));
      worst = std::max(worst, apart);
      EXPECT_LT(apart, 1e-5) << preload << " N, " << hz << " Hz";
    }
  }
  std::printf("%d period maps, multipliers within %.1e\n", n_compared, worst);
  EXPECT_GE(n_compared, 40);
}

TEST(Floquet, FreeModesDecayWithTheirDamping) {
  Scene scene;
  scene.natural_frequency = Eigen::Vector2d(2.0, 5.0);
  scene.damping_ratio = Eigen::Vector2d(0.02, 0.05);
  scene.excitation = Harmonics(1, 2);
  scene.excitation.rows()(1, 0) = 1.0;
  scene.output = Eigen::Vector2d::Ones();
  const double frequency = 1.3;
  const auto curve = solve_at_frequency(scene, frequency, {});
  const auto found = floquet_multipliers(scene, frequency, curve.points.at(0).q, most);
  ASSERT_EQ(found.multipliers.size(), 4);
  for (Eigen::Index mode = 0; mode < 2; ++mode) {
    const double omega = scene.natural_frequency[mode];
    const double zeta = scene.damping_ratio[mode];
    const std::complex<double> exponent(-zeta * omega, omega * std::sqrt(1.0 - zeta * zeta));
    const std::complex<double> expected = std::exp(exponent * two_pi / frequency);
    const auto distance = (found.multipliers.array() - expected).abs().minCoeff();
    EXPECT_LT(distance, 1e-9);  // without contact the variation of a period is exact
  }
  EXPECT_LT(found.distance, 1e-8);  // the linear response is exact
}

TEST(Floquet, MotionsReturnAsFastAsTheMultipliersSay) {
  const Chain chain(9);
  const double hz = 27.25;
  const ResponsePoint point = chain.at(hz);
  EXPECT_EQ(point.stability, Stability::stable);
  const TimeSystem system(chain.scene, point.frequency);
  TimeState state = state_on(system, point.q);
  const auto steady = integrate_to_steady_state(system, {}, state);
  ASSERT_TRUE(steady.periodic);
  const auto found = floquet_multipliers(chain.scene, point.frequency, point.q, most);
  // A pair turns on an ellipse: over 60 periods its axes change the mean factor by some 1 %.
  EXPECT_NEAR(measured_factor(system, state, 80), found.largest_oscillating(), 0.01);
  EXPECT_LT(found.largest_oscillating(), 0.95);
}

TEST(Floquet, MotionThatLeavesItsSolutionHasAPairOutsideTheUnitCircle) {
  // No exponent of Hill's problem grows here, no determinant is negative, and yet time integration
  // leaves the solution, from any disturbance at all.
  const Chain chain(15);
  const ResponsePoint point = chain.at(27.78);
  EXPECT_GT(point.determinant_sign, 0.0);
  EXPECT_EQ(point.stability, Stability::unstable);
  const auto found = floquet_multipliers(chain.scene, point.frequency, point.q, most);
  EXPECT_LT(found.distance, 1e-3);  // truncation
  EXPECT_NEAR(found.largest_oscillating(), 1.028, 2e-3);
  // Along the way the motion is 5e-5 … 5e-3 away from the solution, and the ellipse as above.
  const TimeSystem system(chain.scene, point.frequency);
  EXPECT_NEAR(measured_factor(system, state_on(system, point.q), 120), found.largest_oscillating(),
              0.01);
  TimeOptions options;
  options.max_periods = 1500;
  options.step_tolerance = 1e-7;
  const TimePoint end = tests::steady_state_from(chain.scene, point.frequency, point.q, options);
  EXPECT_FALSE(end.periodic);  // with no period of one to four cycles
  EXPECT_GT((end.response.q.rows() - point.q.rows().topRows(11)).middleRows(1, 2).norm(),
            0.05 * point.q.rows().middleRows(1, 2).norm());
}

TEST(Floquet, JudgesSingleSolutionsOfManyPointsToo) {
  // The same chain on 40 points that are one: more states than every point of a curve is worth.
  Scene scene = tests::three_dof_scene(15.0);
  const auto& one = dynamic_cast<const tests::ReadablePatch&>(*scene.contact);
  constexpr Eigen::Index n = 40;
  std::vector<contact::PointParameters> points(n, one.patch().points()[0]);
  const Eigen::VectorXd weights = Eigen::VectorXd::Constant(n, one.patch().weights()[0] / n);
  contact::ModalShapes shapes{one.shapes().u.replicate(n, 1), one.shapes().v.replicate(n, 1), {}};
  scene.contact = std::make_unique<tests::ReadablePatch>(
      contact::ContactPatch(weights, std::move(points)), std::move(shapes));
  tests::add_transient(scene);
  tests::use_event_cycles(scene);
  ContinuationOptions options;
  options.n_harmonics = 5;
  const ResponseCurve curve = solve_at_frequency(scene, two_pi * 27.78, options);
  ASSERT_TRUE(curve.complete);
  EXPECT_EQ(curve.points[0].stability, Stability::unstable);
  EXPECT_EQ(curve.points[0].stability_basis, StabilityBasis::period_map);
  scene.transient = nullptr;  // Hill's exponents do not see it, and say so
  const ResponseCurve unproved = solve_at_frequency(scene, two_pi * 27.78, options);
  EXPECT_EQ(unproved.points.at(0).stability, Stability::stable);
  EXPECT_EQ(unproved.points.at(0).stability_basis, StabilityBasis::hill);
}

TEST(Floquet, IsNotKnownBeyondTheStatesAllowed) {
  const Chain chain(5);
  const ResponsePoint point = chain.at(22.0);
  EXPECT_FALSE(floquet_multipliers(chain.scene, point.frequency, point.q, 3).known());
  EXPECT_TRUE(floquet_multipliers(chain.scene, point.frequency, point.q, 5).known());
}

TEST(Floquet, PointStuckForGoodAddsNothing) {
  Scene scene = tests::three_dof_scene(1e5);
  tests::add_transient(scene);
  tests::use_event_cycles(scene);
  ContinuationOptions options;
  options.n_harmonics = 3;
  const auto curve = solve_at_frequency(scene, two_pi * 22.0, options);
  ASSERT_TRUE(curve.complete);
  const auto found = floquet_multipliers(scene, two_pi * 22.0, curve.points.at(0).q, most);
  ASSERT_EQ(found.multipliers.size(), 4);  // two modes, no slider
  EXPECT_LT(found.multipliers.cwiseAbs().maxCoeff(), 1.0);
}

}  // namespace
}  // namespace microslip::solver::test_floquet
