/// @file
/// What a motion in time does over its last periods, gathered step by step: harmonics, extremes of
/// the output, work of every force, contact states.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "contact/modal_force.hpp"
#include "solver/time/time_stepper.hpp"

namespace microslip::solver {

/// Work per period [J].
struct PeriodWork {
  double excitation = 0.0;  ///< ∮ Qᵀq̇ dt
  double damping = 0.0;     ///< ∮ q̇ᵀC q̇ dt
  double contact = 0.0;     ///< ∮ Gᵀq̇ dt = excitation − damping in a periodic motion
  double slip = 0.0;        ///< ∮ Σ w μ n |ds|, from the sliders
};

class TimeRecorder final : public TimeObserver {
 public:
  /// @param before  memory at the begin: a stick phase that goes on is not counted anew.
  TimeRecorder(const TimeSystem& system, int n_harmonics, const TransientMemory& before);
  void take(const TimeSegment& segment, double end, const TransientMemory& memory,
            double slip_work) override;

  /// All of these over the time recorded so far, whole periods.
  [[nodiscard]] Harmonics harmonics() const;
  [[nodiscard]] double half_peak_to_peak() const { return 0.5 * (highest_ - lowest_); }
  [[nodiscard]] PeriodWork work() const;
  [[nodiscard]] contact::CycleReport report() const;
  /// Stick phases of each point per period recorded; a point that never does anything else has one
  /// in all.
  [[nodiscard]] std::vector<int> stick_phases() const;

 private:
  void add_integrals(const TimeSegment& segment, double end);
  void add_extremes(const TimeSegment& segment, double end);
  void add_states(double duration, const TransientMemory& memory);
  [[nodiscard]] double n_periods() const { return duration_ / system_.period(); }

  const TimeSystem& system_;
  Harmonics integrals_;  // ∫ q {1, sin kθ, cos kθ} dt
  double duration_ = 0.0;
  double highest_;
  double lowest_;
  PeriodWork work_;
  contact::CycleReport report_;
  std::vector<contact::ContactState> state_;
  std::vector<int> stick_phases_;
};

}  // namespace microslip::solver
