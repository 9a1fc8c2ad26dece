// What is hard: contact states in time that tie, touch or never end.
// Met in: theory sections 4.4, 4.5; rows 3, 4, 8, 9, 33, 50c and 51 of the list of hard cases.
// Right: no storm of events, finite numbers, energy of a steady period balanced, closed forms met.

#include <cmath>
#include <complex>
#include <vector>

#include <gtest/gtest.h>

#include "contact/transient/patch_transient.hpp"
#include "solver/time_integration.hpp"
#include "tests/support/modal_scenes.hpp"
#include "tests/support/random_scene.hpp"
#include "tests/support/steady_states.hpp"

namespace microslip::time_integration {
namespace {

solver::TimePoint settled(const tests::SinglePoint& single, double omega,
                          double energy_tolerance = 1e-6) {
  solver::Scene scene = tests::single_point_scene(single);
  tests::add_transient(scene);
  solver::TimeOptions options;
  options.max_periods = 2000;
  const auto point = tests::steady_state(scene, omega, options);
  EXPECT_TRUE(std::isfinite(point.response.amplitude));
  if (point.periodic) {
    EXPECT_LT(point.response.energy_imbalance, energy_tolerance);
  }
  return point;
}

double linear_amplitude(const tests::SinglePoint& single, double stiffness, double omega) {
  return std::abs(single.force) /
         std::hypot(1.0 + stiffness - omega * omega, 2.0 * single.damping_ratio * omega);
}

// Positive slip and stick are the same force: k_u u − μ k_v v is constant (hard case 3, L₁ = 0).
TEST(TiedStates, SlipFunctionThatNeverChanges) {
  tests::SinglePoint single;
  single.damping_ratio = 0.05;
  single.phi_u = 0.5;
  single.phi_v = 1.0;
  for (const double preload : {-0.2, 0.0, 0.5, 2.0}) {
    single.point = {4.0, 4.0, 0.5, preload};  // 4 · 0.5 = 0.5 · 4 · 1
    const auto point = settled(single, 0.9);
    EXPECT_TRUE(point.periodic) << preload;
  }
}

// In-phase motion with stick throughout each contact: the special sequence S E (theory
// section 4.4).
TEST(TiedStates, StickFromTouchToSeparation) {
  tests::SinglePoint single;
  single.damping_ratio = 0.05;
  single.phi_u = 0.3;
  single.phi_v = 1.0;
  single.point = {1.0, 4.0, 0.8, -0.1};
  const auto point = settled(single, 1.2);
  ASSERT_TRUE(point.periodic);
  EXPECT_EQ(point.response.report.slip_share, 0.0);
  EXPECT_GT(point.response.report.stick_share, 0.0);
  EXPECT_GT(point.response.report.separated_share, 0.0);
}

// No tangential motion at all: friction has nothing to decide.
TEST(TiedStates, NormalMotionAlone) {
  tests::SinglePoint single;
  single.damping_ratio = 0.05;
  single.phi_u = 0.0;
  single.phi_v = 1.0;
  for (const double preload : {-0.3, 0.0, 0.3}) {
    single.point = {4.0, 4.0, 0.5, preload};
    EXPECT_TRUE(settled(single, 1.3).periodic) << preload;
  }
}

// Load that falls to zero and no further (hard case 4): preload equal to the amplitude of the stuck
// load, to rounding and a little to each side. Integration starts on the stuck motion: from rest
// the transient separates and ends in another steady state.
TEST(Grazing, OfTheLoadInNormalMotion) {
  tests::SinglePoint single;
  single.damping_ratio = 0.05;
  single.phi_u = 0.0;
  single.phi_v = 1.0;
  const double omega = 0.7;
  const std::complex<double> stuck =
      1.0 / std::complex<double>(5.0 - omega * omega, 2.0 * single.damping_ratio * omega);
  const double amplitude = std::abs(stuck);
  solver::Harmonics q(1, 1);
  q.rows() << 0.0, stuck.real(), stuck.imag();
  for (const double excess : {-1e-6, -1e-12, -1e-15, 0.0, 1e-15, 1e-12, 1e-6}) {
    single.point = {4.0, 4.0, 0.5, 4.0 * amplitude * (1.0 + excess)};
    solver::Scene scene = tests::single_point_scene(single);
    tests::add_transient(scene);
    const auto point = tests::steady_state_from(scene, omega, q, {});
    ASSERT_TRUE(point.periodic) << excess;
    // Separation of relative depth ε lasts √ε and changes the force by ε^(3/2).
    EXPECT_NEAR(point.response.amplitude, amplitude, 1e-6 * amplitude) << excess;
    EXPECT_LT(point.response.report.separated_share, 1e-3) << excess;
  }
}

// Friction that reaches its limit and no further (onset of slip).
TEST(Grazing, OfTheFrictionLimit) {
  tests::SinglePoint single;
  single.damping_ratio = 0.05;
  const double omega = 0.7;
  const double amplitude = linear_amplitude(single, 4.0, omega);
  // The transient from rest overshoots and slips a few times; what remains is stuck again.
  for (const double excess : {0.0, 1e-12, 1e-6}) {
    single.point = {4.0, 0.0, 0.5, 8.0 * amplitude * (1.0 + excess)};
    const auto point = settled(single, omega);
    ASSERT_TRUE(point.periodic) << excess;
    EXPECT_NEAR(point.response.amplitude, amplitude, 1e-6 * amplitude) << excess;
  }
}

// A gap that is never closed and friction that is not there (hard cases 8, 9).
TEST(NothingToDo, OpenGapAndNoFriction) {
  tests::SinglePoint single;
  single.damping_ratio = 0.05;
  const double omega = 0.7;
  const double free = linear_amplitude(single, 0.0, omega);
  single.phi_v = 1.0;
  single.point = {4.0, 4.0, 0.5,
                  -4.0 * 3.0 * free};  // a gap of three amplitudes: no transient closes it
  EXPECT_NEAR(settled(single, omega).response.amplitude, free, 1e-6 * free);
  single.phi_v = 0.0;
  single.point = {4.0, 0.0, 0.0, 1.0};
  const auto frictionless = settled(single, omega);
  EXPECT_NEAR(frictionless.response.amplitude, free, 1e-6 * free);
  EXPECT_EQ(frictionless.work.slip, 0.0);
  single.point = {0.0, 0.0, 0.5, 1.0};  // a spring of no stiffness
  EXPECT_NEAR(settled(single, omega).response.amplitude, free, 1e-6 * free);
}

// No force (hard case 51), and no damping but friction (hard case 33).
TEST(NothingToDo, NoForceAndNoDamping) {
  tests::SinglePoint single;
  single.force = 0.0;
  single.point = {4.0, 0.0, 0.5, 1.0};
  const auto rest = settled(single, 1.0);
  EXPECT_TRUE(rest.periodic);
  EXPECT_EQ(rest.response.amplitude, 0.0);
  single.force = 1.0;
  single.damping_ratio = 0.0;
  single.point = {4.0, 0.0, 0.5, 0.5};
  const auto damped_by_friction = settled(single, 1.3);
  ASSERT_TRUE(damped_by_friction.periodic);
  EXPECT_GT(damped_by_friction.work.slip, 0.0);
  EXPECT_EQ(damped_by_friction.work.damping, 0.0);
}

// Contact 1e2 … 1e6 times stiffer than the structure (hard case 50c): amplitudes approach those of
// rigid friction, each ten times closer in stiffness changes less.
TEST(StiffContact, TendsToRigidFriction) {
  tests::SinglePoint single;
  single.damping_ratio = 0.05;
  std::vector<double> amplitude;
  for (const double stiffness : {1e2, 1e3, 1e4, 1e5}) {
    single.point = {stiffness, 0.0, 0.5, 1.0};
    amplitude.push_back(settled(single, 0.75).response.amplitude);
  }
  for (std::size_t i = 2; i < amplitude.size(); ++i) {
    EXPECT_LT(std::abs(amplitude[i] - amplitude[i - 1]),
              0.5 * std::abs(amplitude[i - 1] - amplitude[i - 2]));
  }
}

// One-sided contact at zero gap with a hard stop: separation in every period, impacts in the
// transient.
TEST(StiffContact, HardStop) {
  tests::SinglePoint single;
  single.damping_ratio = 0.05;
  single.phi_v = 1.0;
  single.point = {100.0, 1e4, 0.3, 0.0};
  const auto point = settled(single, 2.1);
  EXPECT_TRUE(point.periodic);
  EXPECT_GT(point.response.report.separated_share, 0.5);
}

}  // namespace
}  // namespace microslip::time_integration
