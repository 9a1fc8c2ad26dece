#include "solver/time/time_stepper.hpp"

#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "contact/transient/patch_transient.hpp"
#include "tests/support/modal_scenes.hpp"
#include "tests/support/random_scene.hpp"

namespace microslip::solver::test_time_stepper {
namespace {

Scene oscillator(const contact::PointParameters& point) {
  tests::SinglePoint single;
  single.damping_ratio = 0.05;
  single.point = point;
  Scene scene = tests::single_point_scene(single);
  tests::add_transient(scene);
  return scene;
}

TimeOptions with(TimeMethod method, int n_steps = 0) {
  TimeOptions options;
  options.method = method;
  options.steps_per_period = n_steps;
  return options;
}

TEST(TimeSystem, RefusesWhatItCannotIntegrate) {
  const Scene good = oscillator({100.0, 0.0, 0.5, 1.0});
  EXPECT_THROW(TimeSystem(good, 0.0), std::invalid_argument);
  EXPECT_THROW(TimeSystem(good, std::numeric_limits<double>::quiet_NaN()), std::invalid_argument);
  Scene unseen = oscillator({100.0, 0.0, 0.5, 1.0});
  unseen.transient = nullptr;  // contact for harmonic balance only
  EXPECT_THROW(TimeSystem(unseen, 1.0), std::invalid_argument);
  Scene short_output = oscillator({100.0, 0.0, 0.5, 1.0});
  short_output.output.resize(0);
  EXPECT_THROW(TimeSystem(short_output, 1.0), std::invalid_argument);
}

TEST(TimeSystem, KnowsTheLargestFrequencyOfTheStuckSystem) {
  const Scene scene = oscillator({1e6, 0.0, 0.5, 1.0});
  const TimeSystem system(scene, 1.0);
  EXPECT_NEAR(system.largest_frequency(), std::sqrt(1.0 + 1e6), 1e-9 * 1e3);
  // h ≤ 2/ω_max: a period of 2π takes π · 1000 steps at least.
  EXPECT_EQ(system.least_steps(), static_cast<int>(std::ceil(M_PI * std::sqrt(1.0 + 1e6))));
}

TEST(TimeSystem, AddsUpEveryHarmonicOfTheExcitation) {
  Scene scene = oscillator({1.0, 0.0, 0.5, 1.0});
  scene.excitation = contact::Harmonics(3, 1);
  scene.excitation.rows() << 0.5, 1.0, -2.0, 0.3, 0.0, 0.0, 0.7;
  const TimeSystem system(scene, 2.0);
  for (const double time : {0.0, 0.3, 1.7}) {
    EXPECT_NEAR(system.excitation(time)[0], scene.excitation.at(2.0 * time)[0], 1e-15);
  }
}

TEST(Rk4, RefusesStepsBeyondTheBoundAndSaysHowManyItNeeds) {
  const Scene scene = oscillator({1e6, 0.0, 0.5, 1.0});
  const TimeSystem system(scene, 1.0);
  try {
    (void)make_stepper(system, with(TimeMethod::rk4, 2200));
    FAIL() << "2200 steps accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find(std::to_string(system.least_steps())),
              std::string::npos)
        << error.what();
  }
  EXPECT_NO_THROW((void)make_stepper(system, with(TimeMethod::rk4, system.least_steps())));
}

TEST(Rk4, IsStableAtTheBound) {
  // The bound leaves √2 to the limit 2√2 of the method; a system that is always stuck shows it.
  const Scene scene = oscillator({1e4, 0.0, 0.5, 1e9});
  const TimeSystem system(scene, 1.0);
  const auto stepper = make_stepper(system, with(TimeMethod::rk4, system.least_steps()));
  TimeState state = state_at_rest(system);
  for (int i = 0; i < 200; ++i) stepper->advance_period(state, nullptr);
  EXPECT_LT(std::abs(state.motion.q[0]), 2e-4);  // about 1/k
}

TEST(Steppers, RefuseOptionsOutOfRange) {
  const Scene scene = oscillator({100.0, 0.0, 0.5, 1.0});
  const TimeSystem system(scene, 1.0);
  for (auto change :
       {+[](TimeOptions& o) { o.step_tolerance = 0.0; },
        +[](TimeOptions& o) { o.periodicity_tolerance = -1.0; },
        +[](TimeOptions& o) { o.max_periods = 0; },
        +[](TimeOptions& o) { o.steps_per_period = -5; },
        +[](TimeOptions& o) { o.n_harmonics = 0; }, +[](TimeOptions& o) { o.max_events = -1; }}) {
    TimeOptions options;
    change(options);
    EXPECT_THROW((void)make_stepper(system, options), std::invalid_argument);
  }
}

TEST(Events, RefuseFixedStepsBeyondTheBound) {
  const Scene scene = oscillator({1e6, 0.0, 0.5, 1.0});
  const TimeSystem system(scene, 1.0);
  TimeOptions options = with(TimeMethod::events, 2200);
  options.step_tolerance = std::numeric_limits<double>::infinity();
  EXPECT_THROW((void)make_stepper(system, options), std::invalid_argument);
}

TEST(Events, NameAStormOfEvents) {
  const Scene scene = oscillator({100.0, 0.0, 0.5, 1.0});
  const TimeSystem system(scene, 0.15);
  TimeOptions options;
  options.max_events = 3;
  const auto stepper = make_stepper(system, options);
  TimeState state = state_at_rest(system);
  try {
    stepper->advance_period(state, nullptr);
    FAIL() << "more than three events went by";
  } catch (const TimeError& error) {
    EXPECT_EQ(error.diagnosis(), Diagnosis::event_chatter);
  }
}

TEST(Events, StayAtRestWithoutForce) {
  Scene scene = oscillator({100.0, 0.0, 0.5, 1.0});
  scene.excitation.rows().setZero();
  const TimeSystem system(scene, 1.0);
  const auto stepper = make_stepper(system, {});
  TimeState state = state_at_rest(system);
  stepper->advance_period(state, nullptr);
  EXPECT_EQ(state.motion.q[0], 0.0);
  EXPECT_EQ(stepper->n_events(), 0);
}

/// How many segments a motion is made of.
class Count final : public TimeObserver {
 public:
  void take(const TimeSegment& /*segment*/, double /*end*/, const TransientMemory& /*memory*/,
            double /*slip_work*/) override {
    ++n_;
  }
  [[nodiscard]] int n() const { return n_; }

 private:
  int n_ = 0;
};

/// Many points of one kind change state together: as many events, but one instant.
TEST(Events, OfEqualPointsAreOneInstant) {
  const auto motion = [](Eigen::Index n) {
    tests::SinglePoint single;
    single.damping_ratio = 0.05;
    Scene scene = tests::single_point_scene(single);
    scene.contact = nullptr;
    const auto share = 1.0 / static_cast<double>(n);
    scene.transient = std::make_unique<contact::PatchTransient>(
        contact::ContactPatch(Eigen::VectorXd::Constant(n, share),
                              std::vector<contact::PointParameters>(static_cast<std::size_t>(n),
                                                                    {100.0, 0.0, 0.5, 1.0})),
        contact::ModalShapes{Eigen::MatrixXd::Ones(n, 1), Eigen::MatrixXd::Zero(n, 1), {}});
    const TimeSystem system(scene, 0.5);
    const auto stepper = make_stepper(system, {});
    TimeState state = state_at_rest(system);
    Count segments;
    for (int i = 0; i < 3; ++i) stepper->advance_period(state, &segments);
    return std::tuple(segments.n(), stepper->n_events(), state.motion.q[0]);
  };
  const auto [few, one_events, one_q] = motion(1);
  const auto [many, all_events, all_q] = motion(64);
  EXPECT_EQ(all_events, 64 * one_events);
  EXPECT_NEAR(all_q, one_q, 1e-9 * std::abs(one_q));
  EXPECT_EQ(many, few);
}

TEST(Events, GoThroughContactAMillionTimesStifferThanTheStructure) {
  const Scene scene = oscillator({1e6, 0.0, 0.5, 1.0});
  const TimeSystem system(scene, 0.5);
  const auto stepper = make_stepper(system, {});
  TimeState state = state_at_rest(system);
  for (int i = 0; i < 3; ++i) stepper->advance_period(state, nullptr);
  // Rigid friction is the limit: nothing moves further than the oscillator without friction.
  EXPECT_LT(std::abs(state.motion.q[0]), 1.0 / (1.0 - 0.25));
  EXPECT_GT(stepper->n_events(), 10);
}

TEST(StateOn, AMotionOfTheStuckPointLeavesTheSliderVirgin) {
  const Scene scene = oscillator({2.0, 0.0, 0.5, 1e3});
  const TimeSystem system(scene, 1.0);
  Harmonics q(1, 1);
  q.rows() << 0.1, 0.4, -0.2;
  const TimeState state = state_on(system, q);
  EXPECT_DOUBLE_EQ(state.motion.q[0], 0.1 - 0.2);
  EXPECT_DOUBLE_EQ(state.motion.velocity[0], 0.4);
  EXPECT_EQ(state.memory.slider[0], 0.0);
}

}  // namespace
}  // namespace microslip::solver::test_time_stepper
