#include "solver/time/time_stepper.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "contact/trigonometric_basis.hpp"
#include "solver/time/time_events.hpp"
#include "solver/time/time_rk4.hpp"

namespace microslip::solver {
namespace {

void check(const TimeOptions& options) {
  require_for_time(
      options.steps_per_period >= 0,
      "steps_per_period = " + std::to_string(options.steps_per_period) + " must be at least 0");
  require_for_time(
      options.step_tolerance > 0.0,
      "step_tolerance = " + std::to_string(options.step_tolerance) + " must be above 0");
  require_for_time(options.periodicity_tolerance > 0.0,
                   "periodicity_tolerance = " + std::to_string(options.periodicity_tolerance) +
                       " must be above 0");
  require_for_time(options.max_periods >= 1 && options.min_periods >= 1,
                   "max_periods and min_periods must be at least 1");
  require_for_time(options.max_events >= 0, "max_events must be at least 0");
  require_for_time(options.n_harmonics >= 1, "n_harmonics must be at least 1");
}

/// dq/dθ.
Harmonics by_phase(const Harmonics& q) {
  Harmonics rate(q.n_harmonics(), q.n_signals());
  for (int h = 1; h <= q.n_harmonics(); ++h) {
    rate.rows().row(2 * h) = h * q.sine(h);
    rate.rows().row(2 * h - 1) = -h * q.cosine(h);
  }
  return rate;
}

}  // namespace

void TimeStepper::reach(const ModalMotion& motion) {
  const double displacement = motion.q.norm();
  const double velocity = motion.velocity.norm();
  if (!std::isfinite(displacement) || !std::isfinite(velocity)) {
    throw TimeError(Diagnosis::out_of_range, "the motion grows beyond all numbers");
  }
  levels_.current.displacement = std::max(levels_.current.displacement, displacement);
  levels_.current.velocity = std::max(levels_.current.velocity, velocity);
}

void TimeStepper::close_period() {
  levels_.last = levels_.current;
  levels_.current = {};
}

std::unique_ptr<TimeStepper> make_stepper(const TimeSystem& system, const TimeOptions& options) {
  check(options);
  if (options.method == TimeMethod::rk4) return std::make_unique<Rk4Stepper>(system, options);
  return std::make_unique<EventStepper>(system, options);
}

TimeState state_at_rest(const TimeSystem& system) {
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(system.n_modes());
  TimeState state{{zero, zero}, {}};
  if (system.contact() != nullptr) state.memory = system.contact()->virgin_memory();
  return state;
}

TimeState state_on(const TimeSystem& system, const Harmonics& q) {
  TimeState state = state_at_rest(system);
  const Harmonics rate = by_phase(q);
  if (system.contact() != nullptr) {
    constexpr int n_samples = 720;
    Eigen::VectorXd basis;
    ModalMotion now;
    for (int i = 0; i <= 2 * n_samples; ++i) {  // the period map of sliders on a line is idempotent
      contact::trigonometric_basis(q.n_harmonics(), 2.0 * std::numbers::pi * i / n_samples, basis);
      now.q = q.rows().transpose().lazyProduct(basis);
      now.velocity = system.frequency() * rate.rows().transpose().lazyProduct(basis);
      system.contact()->commit(now, state.memory);
    }
  }
  state.motion = {q.at(0.0), system.frequency() * rate.at(0.0)};
  return state;
}

}  // namespace microslip::solver
