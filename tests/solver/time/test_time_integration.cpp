#include "solver/time_integration.hpp"

#include <cmath>
#include <complex>

#include <gtest/gtest.h>

#include "solver/balance/output_amplitude.hpp"
#include "solver/continuation.hpp"
#include "tests/support/modal_scenes.hpp"
#include "tests/support/random_scene.hpp"
#include "tests/support/steady_states.hpp"

namespace microslip::solver::test_time_integration {
namespace {

using tests::steady_state;
using tests::steady_state_from;

Scene oscillator(double preload, double damping = 0.05) {
  tests::SinglePoint single;
  single.damping_ratio = damping;
  single.point = {3.0, 0.0, 0.5, preload};
  Scene scene = tests::single_point_scene(single);
  tests::add_transient(scene);
  return scene;
}

class Methods : public testing::TestWithParam<TimeMethod> {
 protected:
  [[nodiscard]] static TimeOptions options() {
    TimeOptions options;
    options.method = GetParam();
    return options;
  }
};
INSTANTIATE_TEST_SUITE_P(Both, Methods, testing::Values(TimeMethod::events, TimeMethod::rk4));

TEST_P(Methods, ReachTheLinearResponseWithoutContact) {
  Scene scene = oscillator(0.0);
  scene.contact = nullptr;
  scene.transient = nullptr;
  scene.excitation = contact::Harmonics(3, 1);
  scene.excitation.rows() << 0.2, 1.0, 0.0, 0.0, 0.5, 0.3, 0.0;
  const double omega = 0.6;
  const TimePoint point = steady_state(scene, omega, options());
  ASSERT_TRUE(point.periodic);
  EXPECT_EQ(point.period_multiple, 1);
  EXPECT_NEAR(point.response.mean, 0.2, 1e-7);
  for (int h = 1; h <= 3; ++h) {
    // (1 − h²ω² + 2iζhω) A = Q with A = a_s + i a_c
    const std::complex<double> force(scene.excitation.sine(h)[0], scene.excitation.cosine(h)[0]);
    const double k = h * omega;
    const auto expected = force / std::complex<double>(1.0 - k * k, 2.0 * 0.05 * k);
    EXPECT_NEAR(point.response.q.sine(h)[0], expected.real(), 1e-6) << h;
    EXPECT_NEAR(point.response.q.cosine(h)[0], expected.imag(), 1e-6) << h;
  }
  EXPECT_EQ(point.response.stability, Stability::stable);
  EXPECT_TRUE(point.stick_phases.empty());
}

TEST_P(Methods, ComeToRestUnderAStaticForceAlone) {
  // A step load: from 0 the motion decays to where the spring, and with contact whatever the slider
  // holds, carries it.
  for (const bool rubs : {false, true}) {
    Scene scene = oscillator(1.0);
    if (!rubs) {
      scene.contact = nullptr;
      scene.transient = nullptr;
    }
    scene.excitation = contact::Harmonics(1, 1);
    scene.excitation.rows()(0, 0) = 2.0;
    TimeState state;
    for (const double omega : {0.6, 0.9}) {  // the second begins at rest
      const TimeSystem system(scene, omega);
      if (omega == 0.6) state = state_at_rest(system);
      const TimePoint point = integrate_to_steady_state(system, options(), state);
      ASSERT_TRUE(point.periodic) << rubs << ' ' << omega;
      EXPECT_EQ(point.period_multiple, 1);
      EXPECT_LT(point.n_periods, 200);
      // 1e-7, the tolerance, of twice the static response, the largest motion.
      EXPECT_LT(point.response.amplitude, 1e-6);
      EXPECT_LT(point.response.energy_imbalance, 1e-6);
      if (!rubs) {
        EXPECT_NEAR(point.response.mean, 2.0, 1e-6);
      } else {
        EXPECT_LE(std::abs(2.0 - point.response.mean), 0.5 * (1.0 + 1e-6));  // held by friction
      }
    }
  }
}

TEST_P(Methods, ComeToRestWithoutAnyForce) {
  Scene scene = oscillator(0.0);
  scene.contact = nullptr;
  scene.transient = nullptr;
  scene.excitation.rows().setZero();
  contact::Harmonics begin(1, 1);
  begin.rows()(1, 0) = 1.0;
  const TimePoint point = steady_state_from(scene, 0.9, begin, options());
  ASSERT_TRUE(point.periodic);
  EXPECT_LT(point.n_periods, 200);
  EXPECT_LT(point.response.amplitude, 1e-6);  // tolerance 1e-7 of the largest motion, 1.1
}

TEST_P(Methods, GiveHalfThePeakToPeakValueOfTheMotion) {
  const TimePoint point = steady_state(oscillator(1.0), 0.5, options());
  TimeOptions fine = options();
  fine.n_harmonics = 60;
  const TimePoint many = steady_state(oscillator(1.0), 0.5, fine);
  const Eigen::VectorXd output = Eigen::VectorXd::Ones(1);
  // Harmonics of a force with kinks in its slope fall like k⁻³, those of q like k⁻⁵.
  EXPECT_NEAR(output_amplitude(many.response.q, output).half_peak_to_peak, point.response.amplitude,
              1e-6);
}

TEST_P(Methods, TellStateSharesThatSumToOne) {
  const TimePoint point = steady_state(oscillator(1.0), 0.5, options());
  const auto& report = point.response.report;
  EXPECT_NEAR(report.stick_share + report.slip_share + report.separated_share, 1.0, 1e-12);
  EXPECT_GT(report.stick_share, 0.0);
  EXPECT_GT(report.slip_share, 0.0);
  EXPECT_EQ(report.three_states_share, 0.0);
  EXPECT_NEAR(report.slip_work, point.work.contact, 1e-3 * point.work.contact);
}

TEST_P(Methods, CountTheStickPhaseOfAPointThatNeverSlipsAsOne) {
  const TimePoint point = steady_state(oscillator(1e6), 0.5, options());
  EXPECT_EQ(point.stick_phases, std::vector<int>{1});
  EXPECT_EQ(point.n_events, 0);
}

TEST_P(Methods, SayWhenTheCapIsReachedBeforeTheMotionRepeats) {
  TimeOptions few = options();
  few.max_periods = 5;
  const TimePoint point = steady_state(oscillator(0.1, 0.001), 1.01, few);
  EXPECT_FALSE(point.periodic);
  EXPECT_EQ(point.period_multiple, 0);
  EXPECT_EQ(point.n_periods, 5);
  EXPECT_EQ(point.response.stability, Stability::not_assessed);
  EXPECT_GT(point.response.residual, few.periodicity_tolerance);
}

TEST(SteadyState, FromHarmonicBalanceTakesFewerPeriodsToTheSameEnd) {
  const Scene scene = oscillator(1.0, 0.002);
  const auto balance = solve_at_frequency(scene, 0.9, {});
  ASSERT_TRUE(balance.complete);
  const TimePoint cold = steady_state(scene, 0.9, {});
  const TimePoint warm = steady_state_from(scene, 0.9, balance.points.front().q, {});
  ASSERT_TRUE(cold.periodic && warm.periodic);
  EXPECT_LT(warm.n_periods, cold.n_periods);
  EXPECT_NEAR(warm.response.amplitude, cold.response.amplitude, 1e-6 * cold.response.amplitude);
}

}  // namespace
}  // namespace microslip::solver::test_time_integration
