/// @file
/// Event-locating integration of full order (theory section 18): while contact states are held the
/// right side is smooth, and steps are taken by the pair of Dormand and Prince of order 5(4) (J.
/// Comput. Appl. Math. 6 (1980) 19–26); where a state ends the step is cut, the state switched, and
/// integration goes on. Where the force of a held state has a kink (cubic heights: all in contact)
/// the step is taken again to end there: a step across would be of order four.
#pragma once

#include "solver/time/time_stepper.hpp"

namespace microslip::solver {

class EventStepper final : public TimeStepper {
 public:
  /// @throws std::invalid_argument  fixed steps (infinite tolerance) beyond the bound of the
  ///         method.
  EventStepper(const TimeSystem& system, const TimeOptions& options);
  void advance_period(TimeState& state, TimeObserver* observer) override;
  [[nodiscard]] long n_events() const override { return n_events_; }
  [[nodiscard]] Eigen::VectorXd contact_force(const TimeState& state) const override {
    return system_.contact()->held_force(state.motion, state.memory);
  }

 private:
  /// What a step adds, and its error against the size of the motion.
  struct Step {
    Eigen::VectorXd displacement;
    Eigen::VectorXd velocity;
    Eigen::VectorXd acceleration_end;
    InternalPolynomials internal;  // of the internal variables
    double error = 0.0;
  };
  [[nodiscard]] contact::GuardScale scale() const;
  [[nodiscard]] Eigen::VectorXd acceleration(double time, const ModalMotion& motion,
                                             const TransientMemory& memory);
  /// q̈ where an observer, a guard or a switch sees the motion.
  void accelerate(double time, TimeState& state);
  [[nodiscard]] Step try_step(double time, double length, const TimeState& state);
  /// Shortens `length` until the error is within the tolerance and proposes the next one.
  [[nodiscard]] Step accepted_step(double time, double& length, const TimeState& state);
  /// A step and its polynomial.
  struct Taken {
    Step step;
    TimeSegment segment;
  };
  /// accepted_step() that ends at the latest where the force has a kink.
  [[nodiscard]] Taken smooth_step(double time, double& length, const TimeState& state);
  static void move_to(double x, const TimeSegment& segment, TimeState& state);
  /// Ends states that are violated as they stand.
  void settle(TimeState& state);
  void count_events(std::size_t n);
  void observe(TimeObserver* observer, const TimeSegment& segment, double end,
               const TransientMemory& memory) const;

  const TimeSystem& system_;
  double tolerance_;
  double longest_step_;
  double next_step_;
  long max_events_;
  long period_events_ = 0;
  long n_events_ = 0;
};

}  // namespace microslip::solver
