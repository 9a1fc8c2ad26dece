/// @file
/// Fixed-step fourth-order Runge–Kutta with slider memory committed once per step (paper B, eq. 13;
/// theory section 18). Within a step the trial force lets the sliders of its begin give way; order
/// 4 while nothing slips, between 1 and 2 otherwise.
#pragma once

#include "solver/time/time_stepper.hpp"

namespace microslip::solver {

class Rk4Stepper final : public TimeStepper {
 public:
  /// @throws std::invalid_argument  fewer steps per period than TimeSystem::least_steps().
  Rk4Stepper(const TimeSystem& system, const TimeOptions& options);
  void advance_period(TimeState& state, TimeObserver* observer) override;
  [[nodiscard]] long n_events() const override { return n_events_; }
  [[nodiscard]] Eigen::VectorXd contact_force(const TimeState& state) const override {
    return system_.contact()->trial_force(state.motion, state.memory);
  }

 private:
  [[nodiscard]] Eigen::VectorXd acceleration(double time, const ModalMotion& motion,
                                             const TransientMemory& memory);
  void step(double time, double length, TimeState& state, Eigen::VectorXd& acceleration_begin,
            TimeObserver* observer);

  const TimeSystem& system_;
  int n_steps_ = 0;
  long n_events_ = 0;
};

}  // namespace microslip::solver
