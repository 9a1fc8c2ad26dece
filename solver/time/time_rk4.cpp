#include "solver/time/time_rk4.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace microslip::solver {
namespace {

constexpr int default_steps = 1000;  // slip begins and ends to 1/1000 of a period

int n_steps_of(const TimeSystem& system, int asked) {
  const int least = system.least_steps();
  if (asked == 0) return std::max(default_steps, 2 * std::min(least, 1'000'000'000));
  if (asked < least) {
    throw std::invalid_argument("time integration: " + std::to_string(asked) +
                                " steps per period at " + std::to_string(system.frequency()) +
                                " rad/s are too few: the stuck system goes up to " +
                                std::to_string(system.largest_frequency()) +
                                " rad/s and needs at least " + std::to_string(least));
  }
  return asked;
}

}  // namespace

Rk4Stepper::Rk4Stepper(const TimeSystem& system, const TimeOptions& options)
    : system_(system), n_steps_(n_steps_of(system, options.steps_per_period)) {}

Eigen::VectorXd Rk4Stepper::acceleration(double time, const ModalMotion& motion,
                                         const TransientMemory& memory) {
  const contact::TransientForce* contact = system_.contact();
  return system_.acceleration(time, motion,
                              contact != nullptr ? contact->trial_force(motion, memory)
                                                 : Eigen::VectorXd::Zero(system_.n_modes()).eval());
}

void Rk4Stepper::step(double time, double length, TimeState& state,
                      Eigen::VectorXd& acceleration_begin, TimeObserver* observer) {
  const ModalMotion start = state.motion;
  const double half = 0.5 * length;
  const Eigen::VectorXd& a1 = acceleration_begin;
  const ModalMotion m2{start.q + half * start.velocity, start.velocity + half * a1};
  const Eigen::VectorXd a2 = acceleration(time + half, m2, state.memory);
  const ModalMotion m3{start.q + half * m2.velocity, start.velocity + half * a2};
  const Eigen::VectorXd a3 = acceleration(time + half, m3, state.memory);
  const ModalMotion m4{start.q + length * m3.velocity, start.velocity + length * a3};
  const Eigen::VectorXd a4 = acceleration(time + length, m4, state.memory);
  const Eigen::VectorXd displacement_step =
      length / 6.0 * (start.velocity + 2.0 * m2.velocity + 2.0 * m3.velocity + m4.velocity);
  const Eigen::VectorXd velocity_step = length / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
  state.motion.q += displacement_step;
  state.motion.velocity += velocity_step;
  double work = 0.0;
  if (system_.contact() != nullptr) {
    const std::vector<contact::ContactState> before = state.memory.state;
    work = system_.contact()->commit(state.motion, state.memory);
    for (std::size_t i = 0; i < before.size(); ++i) {
      n_events_ += before[i] != state.memory.state[i] ? 1 : 0;
    }
  }
  const Eigen::VectorXd acceleration_end = acceleration(time + length, state.motion, state.memory);
  if (observer != nullptr) {
    observer->take(
        TimeSegment(time, length, start, displacement_step, velocity_step, a1, acceleration_end),
        1.0, state.memory, work);
  }
  acceleration_begin = acceleration_end;
}

void Rk4Stepper::advance_period(TimeState& state, TimeObserver* observer) {
  const double length = system_.period() / n_steps_;
  Eigen::VectorXd acceleration_begin = acceleration(0.0, state.motion, state.memory);
  for (int i = 0; i < n_steps_; ++i) {
    step(i * length, length, state, acceleration_begin, observer);
    reach(state.motion);
  }
  close_period();
}

}  // namespace microslip::solver
