#include "contact/sampled/runs.hpp"

#include <numbers>

namespace microslip::contact::sampled {
namespace {

/// Whether a run begins at an instant. One that has turned sticks on.
bool begins(InstantState before, InstantState now) {
  if (now == InstantState::turned) return true;
  return now != before && !(now == InstantState::stick && before == InstantState::turned);
}

}  // namespace

void find_runs(const double* state, std::size_t n, std::size_t stride, std::vector<Run>& runs) {
  runs.clear();
  InstantState before = instant_state(state[(n - 1) * stride]);
  std::size_t first = 0;
  for (; first < n; ++first) {
    const InstantState now = instant_state(state[first * stride]);
    if (begins(before, now)) break;
    before = now;
  }
  if (first == n) {
    runs.push_back({before, 0, n});
    return;
  }
  for (std::size_t j = 0; j < n; ++j) {
    const std::size_t i = first + j < n ? first + j : first + j - n;
    const InstantState now = instant_state(state[i * stride]);
    if (begins(before, now)) {
      const bool turned = now == InstantState::turned;
      runs.push_back({turned ? InstantState::stick : now, i, 0, turned});
    }
    ++runs.back().length;
    before = now;
  }
}

CycleStates cycle_states(const std::vector<Run>& runs, std::size_t n) {
  const double step = 2.0 * std::numbers::pi / static_cast<double>(n);
  CycleStates result{CycleRegime::full_stick, PeriodStates(ContactState::stick)};
  bool any_slip = false;
  bool any_apart = false;
  for (const Run& run : runs) {
    any_slip = any_slip || slips(run.state) || run.turned;
    any_apart = any_apart || run.state == InstantState::separated;
    result.period.set(static_cast<ContactState>(run.state),
                      (static_cast<double>(run.begin) - 0.5) * step,
                      static_cast<double>(run.length) * step);
  }
  if (any_slip) result.regime = CycleRegime::stick_slip;
  if (any_apart) result.regime = CycleRegime::separation;
  if (any_apart && runs.size() == 1) result.regime = CycleRegime::separated;
  return result;
}

std::vector<CycleSegment> cycle_segments(const std::vector<Run>& runs, std::size_t n) {
  const double step = 2.0 * std::numbers::pi / static_cast<double>(n);
  std::vector<CycleSegment> phases;
  phases.reserve(runs.size());
  for (const Run& run : runs) {
    phases.push_back({static_cast<ContactState>(run.state),
                      (static_cast<double>(run.begin) - 0.5) * step,
                      static_cast<double>(run.length) * step, 0.0});
  }
  return joined_segments(phases, 0.0);
}

}  // namespace microslip::contact::sampled
