/// @file
/// How a scene is integrated in time.
#pragma once

#include <cstdint>
#include <functional>

namespace microslip::solver {

enum class TimeMethod : std::uint8_t {
  events,  ///< Dormand–Prince 5(4), every change of contact state located: full order
  rk4,     ///< fixed steps, sliders committed once per step (paper B): order 1 to 2
};

struct TimeOptions {
  TimeMethod method = TimeMethod::events;
  /// rk4: steps per period, refused below TimeSystem::least_steps(); events: the longest step is a
  /// period divided by this. 0: chosen (rk4: 1000, or twice the least; events: 64).
  int steps_per_period = 0;
  /// events: error per step against the largest motion of a period, > 0. Infinity: fixed steps.
  double step_tolerance = 1e-10;
  /// Estimated distance to the periodic motion, against its size, at which it counts as reached,
  /// > 0.
  double periodicity_tolerance = 1e-7;
  int max_periods = 5000;  ///< ≥ 1, per frequency
  /// Periods at least integrated at each frequency, ≥ 1.
  int min_periods = 4;
  /// events: more changes of state than this in one period are `event-chatter`. 0:
  /// 1000 + 100 per point.
  int max_events = 0;
  int n_harmonics = 5;  ///< H of the result, ≥ 1
  /// Asked after each period: true ends the integration, with TimePoint::stopped.
  std::function<bool()> stop;
};

}  // namespace microslip::solver
