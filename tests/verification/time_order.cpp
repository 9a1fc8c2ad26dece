// Order of convergence and energy of time integration (theory sections 15.3, 18), on the chain of
// section 20.3 at 20 N: one point that sticks and slips, 22 Hz, two periods from rest.
//
// Events: Dormand–Prince with every transition located is of order 5 in fixed steps; the rate is
// taken from three halvings against a solution with four times the steps. Runge–Kutta with sliders
// committed once per step: order 4 while nothing slips, at least 1 where something does (theory: 1
// to 2).

#include <cmath>
#include <cstdio>
#include <limits>

#include <gtest/gtest.h>

#include "solver/time_integration.hpp"
#include "tests/support/modal_scenes.hpp"
#include "tests/support/random_scene.hpp"
#include "tests/support/steady_states.hpp"

namespace microslip::time_order {
namespace {

constexpr double omega = 2.0 * M_PI * 22.0;

Eigen::VectorXd end_state(const solver::Scene& scene, solver::TimeMethod method, int n_steps) {
  const solver::TimeSystem system(scene, omega);
  solver::TimeOptions options;
  options.method = method;
  options.steps_per_period = n_steps;
  options.step_tolerance = std::numeric_limits<double>::infinity();
  const auto stepper = solver::make_stepper(system, options);
  solver::TimeState state = solver::state_at_rest(system);
  for (int i = 0; i < 2; ++i) stepper->advance_period(state, nullptr);
  Eigen::VectorXd end(2 * scene.n_modes());
  end << state.motion.q, state.motion.velocity / omega;
  return end;
}

/// Mean order over three halvings.
double order(const char* name, const solver::Scene& scene, solver::TimeMethod method, int n_steps,
             const Eigen::VectorXd& exact) {
  double first = 0.0;
  double last = 0.0;
  for (int k = 0; k < 4; ++k) {
    const int n = n_steps << k;
    last = (end_state(scene, method, n) - exact).norm() / exact.norm();
    if (k == 0) first = last;
    std::printf("%-12s %6d steps per period, error %.3e\n", name, n, last);
  }
  const double rate = std::log2(first / last) / 3.0;
  std::printf("%-12s order %.2f\n", name, rate);
  return rate;
}

solver::Scene chain(double preload) {
  solver::Scene scene = tests::chain_scene(preload);
  tests::add_transient(scene);
  return scene;
}

TEST(OrderOfConvergence, EventsAreOfOrderFiveThroughSlip) {
  const solver::Scene scene = chain(10.0);
  const Eigen::VectorXd exact = end_state(scene, solver::TimeMethod::events, 2048);
  EXPECT_GT(order("events", scene, solver::TimeMethod::events, 64, exact), 4.7);
}

TEST(OrderOfConvergence, EventsAreOfOrderFiveThroughSeparation) {
  solver::Scene scene = tests::three_dof_scene(10.0);
  tests::add_transient(scene);
  const Eigen::VectorXd exact = end_state(scene, solver::TimeMethod::events, 2048);
  EXPECT_GT(order("separation", scene, solver::TimeMethod::events, 64, exact), 4.7);
}

TEST(OrderOfConvergence, RungeKuttaIsOfOrderFourWhileStuck) {
  const solver::Scene scene = chain(1e6);
  const Eigen::VectorXd exact = end_state(scene, solver::TimeMethod::events, 2048);
  EXPECT_GT(order("rk4 stuck", scene, solver::TimeMethod::rk4, 32, exact), 3.8);
}

TEST(OrderOfConvergence, RungeKuttaIsBetweenOneAndTwoThroughSlip) {
  const solver::Scene scene = chain(10.0);
  const Eigen::VectorXd exact = end_state(scene, solver::TimeMethod::events, 2048);
  const double rate = order("rk4 slip", scene, solver::TimeMethod::rk4, 256, exact);
  EXPECT_GT(rate, 0.9);
}

/// W_exc = W_damp + ∮ μ n |ds| in the steady state; what the motion still moves per period is below
/// the periodicity tolerance, and the energy it moves with it twice that over the damping of a
/// period, 4πζ.
TEST(EnergyBalance, HoldsOverASteadyPeriod) {
  for (const double preload : {0.0, 30.0, 100.0}) {
    for (const double damping : {0.02, 0.005}) {
      solver::Scene scene = tests::three_dof_scene(preload);
      tests::add_transient(scene);
      scene.damping_ratio.setConstant(damping);
      solver::TimeOptions options;
      options.periodicity_tolerance = 1e-9;
      const auto point = tests::steady_state(scene, 2.0 * M_PI * 20.5, options);
      const double tolerance = 1e-9 * 2.0 / (4.0 * M_PI * damping) + 1e-8;  // 1e-8: 1e-10 per step
      std::printf("preload %5.0f, damping %.3f: %4d periods, energy imbalance %.1e\n", preload,
                  damping, point.n_periods, point.response.energy_imbalance);
      ASSERT_TRUE(point.periodic);
      EXPECT_LT(point.response.energy_imbalance, tolerance);
    }
  }
}

}  // namespace
}  // namespace microslip::time_order
