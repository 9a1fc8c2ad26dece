/// @file
/// Steady states of a scene by integration in time: an independent method next to harmonic balance
/// (theory section 18), with the same scene going in and the same numbers coming out.
#pragma once

#include <vector>

#include "solver/response_curve.hpp"
#include "solver/scene.hpp"
#include "solver/time/time_recorder.hpp"
#include "solver/time/time_stepper.hpp"
#include "solver/time_options.hpp"

namespace microslip::solver {

/// The end of a run at one frequency.
struct TimePoint {
  /// As far as it applies: harmonics, `amplitude` as half the peak-to-peak value of the motion
  /// itself, first harmonic, mean, phase; `residual` the distance to the periodic motion against
  /// its size; `energy_imbalance` and `dissipation_mismatch` from the work of forces and sliders;
  /// contact report; stable = 1 with the period of the excitation, not assessed else;
  /// `iterations` the periods integrated.
  ResponsePoint response;
  bool stopped = false;           ///< by TimeOptions::stop, before there was a response
  bool periodic = false;          ///< with period 1 to 4
  int period_multiple = 0;        ///< 1: the period of the excitation; 0: none was found
  int n_periods = 0;              ///< integrated until then
  long n_events = 0;              ///< changes of contact state in the periods recorded
  PeriodWork work;                ///< mean of the periods recorded
  std::vector<int> stick_phases;  ///< of each point, in the periods recorded
};

/// Integrates until the motion repeats itself or max_periods have passed, then records one period
/// more (as many as the period multiple; the largest multiple when nothing repeats). Where it is
/// stopped before, the response is empty.
/// @param state  where to start; left where the run ends, at θ = 0.
/// @throws std::invalid_argument  as TimeSystem and make_stepper().
/// @throws TimeError  as TimeStepper::advance_period().
[[nodiscard]] TimePoint integrate_to_steady_state(const TimeSystem& system,
                                                  const TimeOptions& options, TimeState& state);

}  // namespace microslip::solver
