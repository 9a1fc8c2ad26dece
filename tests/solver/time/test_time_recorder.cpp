#include "solver/time/time_recorder.hpp"

#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "contact/transient/patch_transient.hpp"

namespace microslip::solver::test_time_recorder {
namespace {

using contact::ContactState;

Eigen::VectorXd scalar(double x) { return Eigen::VectorXd::Constant(1, x); }

/// q = 0.3 + 2 sin ωt + 0.5 cos 2ωt, in n steps over a period.
struct Wave {
  double omega = 3.0;
  [[nodiscard]] double q(double t) const {
    return 0.3 + 2.0 * std::sin(omega * t) + 0.5 * std::cos(2.0 * omega * t);
  }
  [[nodiscard]] double velocity(double t) const {
    return omega * (2.0 * std::cos(omega * t) - std::sin(2.0 * omega * t));
  }
  [[nodiscard]] double acceleration(double t) const {
    return -omega * omega * (2.0 * std::sin(omega * t) + 2.0 * std::cos(2.0 * omega * t));
  }
  [[nodiscard]] TimeSegment segment(double t, double h) const {
    return {t,
            h,
            {scalar(q(t)), scalar(velocity(t))},
            scalar(q(t + h) - q(t)),
            scalar(velocity(t + h) - velocity(t)),
            scalar(acceleration(t)),
            scalar(acceleration(t + h))};
  }
};

/// One mode, ω_n = 2, ζ = 0.1, force sin θ, output 1; two points.
Scene two_points() {
  Scene scene;
  scene.natural_frequency = scalar(2.0);
  scene.damping_ratio = scalar(0.1);
  scene.output = scalar(1.0);
  scene.excitation = contact::Harmonics(1, 1);
  scene.excitation.rows()(2, 0) = 1.0;  // cos θ: in phase with the velocity of sin θ
  scene.transient = std::make_unique<contact::PatchTransient>(
      contact::ContactPatch(Eigen::Vector2d(1.0, 3.0),
                            std::vector<contact::PointParameters>(2, {1.0, 0.0, 0.5, 1.0})),
      contact::ModalShapes{Eigen::MatrixXd::Ones(2, 1), Eigen::MatrixXd::Zero(2, 1), {}});
  return scene;
}

std::unique_ptr<TimeRecorder> record(const TimeSystem& system, const Wave& wave, int n) {
  const TransientMemory memory = system.contact()->virgin_memory();
  auto recorder = std::make_unique<TimeRecorder>(system, 3, memory);
  const double h = system.period() / n;
  // Each step cut in two, as events do.
  for (int i = 0; i < n; ++i) {
    recorder->take(wave.segment(i * h, 1.25 * h), 0.4, memory, 0.0);
    recorder->take(wave.segment(i * h + 0.5 * h, h), 0.5, memory, 0.0);
  }
  return recorder;
}

TEST(TimeRecorder, FindsTheHarmonicsOfAMotion) {
  const Scene scene = two_points();
  const Wave wave;
  const TimeSystem system(scene, wave.omega);
  const Harmonics q = record(system, wave, 64)->harmonics();
  Eigen::VectorXd expected = Eigen::VectorXd::Zero(7);
  expected[0] = 0.3;
  expected[1] = 2.0;
  expected[4] = 0.5;
  // The polynomial of degree five leaves (ωh)⁶/46080 in a step, three times that for 2θ.
  EXPECT_LT((q.vector() - expected).norm(), 1e-9);
}

TEST(TimeRecorder, FindsTheExtremesBetweenSteps) {
  const Scene scene = two_points();
  const Wave wave;
  const TimeSystem system(scene, wave.omega);
  // Steps of 1.25/65 of a period: (2ωh)⁶/92160 = 2e-9.
  // 0.3 + 2 sin θ + 0.5 (1 − 2 sin² θ) grows with sin θ (slope 2 − 2 sin θ): from −2.2 to 1.8.
  for (const int n : {65, 71, 128}) {
    EXPECT_NEAR(record(system, wave, n)->half_peak_to_peak(), 0.5 * (1.8 + 2.2), 1e-8) << n;
  }
}

TEST(TimeRecorder, AddsUpTheWorkOfForceAndDamping) {
  const Scene scene = two_points();
  const Wave wave;
  const TimeSystem system(scene, wave.omega);
  const PeriodWork work = record(system, wave, 64)->work();
  // ∮ cos θ q̇ dt = π · 2;  ∮ 2ζω_n q̇² dt = 2ζω_n π ω (2² + 2² · 0.5²)
  EXPECT_NEAR(work.excitation, 2.0 * M_PI, 1e-9);
  EXPECT_NEAR(work.damping, 2.0 * 0.1 * 2.0 * M_PI * wave.omega * (4.0 + 1.0), 1e-7);
  EXPECT_NEAR(work.contact, work.excitation - work.damping, 1e-12);
}

TEST(TimeRecorder, CountsStickPhasesAroundTheEndOfThePeriod) {
  const Scene scene = two_points();
  const Wave wave;
  const TimeSystem system(scene, wave.omega);
  TransientMemory memory = system.contact()->virgin_memory();  // both stick
  TimeRecorder recorder(system, 1, memory);
  const double h = system.period() / 4.0;
  const std::array<ContactState, 4> first{ContactState::stick, ContactState::positive_slip,
                                          ContactState::stick, ContactState::negative_slip};
  // The memory says that the stick phase at θ = 0 began before: it is not counted again.
  for (int i = 0; i < 4; ++i) {
    memory.state[0] = first[static_cast<std::size_t>(i)];
    recorder.take(wave.segment(i * h, h), 1.0, memory, 0.25);
  }
  EXPECT_EQ(recorder.stick_phases(), (std::vector<int>{1, 1}));
  EXPECT_NEAR(recorder.report().stick_share, 0.5 * 0.25 + 0.75, 1e-12);
  EXPECT_NEAR(recorder.report().slip_share, 0.5 * 0.25, 1e-12);
  EXPECT_NEAR(recorder.report().slip_work, 1.0, 1e-12);
}

}  // namespace
}  // namespace microslip::solver::test_time_recorder
