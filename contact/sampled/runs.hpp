/// @file
/// What the instants of one point say: stretches of the same state, and what a step control and a
/// report want to know of them.
#pragma once

#include <cstddef>
#include <vector>

#include "contact/lanes/line_kernels.hpp"
#include "contact/point/cycle_segments.hpp"
#include "contact/point/period_states.hpp"

namespace microslip::contact::sampled {

/// Instants of the same state; goes on at 0 after the last. @param begin in [0, n).
struct Run {
  InstantState state = InstantState::stick;
  std::size_t begin = 0;
  std::size_t length = 0;
  bool turned = false;  ///< sticks, after a slip that ended since the instant before `begin`
};

[[nodiscard]] inline bool slips(InstantState state) {
  return state != InstantState::stick && state != InstantState::separated;
}

/// Of one point, in order of time; neighbours differ, or the second has turned.
/// @param state  n numbers, `stride` apart.   @param runs  written whole.
void find_runs(const double* state, std::size_t n, std::size_t stride, std::vector<Run>& runs);

[[nodiscard]] CycleStates cycle_states(const std::vector<Run>& runs, std::size_t n);
[[nodiscard]] std::vector<CycleSegment> cycle_segments(const std::vector<Run>& runs, std::size_t n);

}  // namespace microslip::contact::sampled
