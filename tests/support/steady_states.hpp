/// @file
/// Steady states of a scene by integration in time, from rest, from a solution of harmonic balance,
/// or along a list of frequencies: a referee of points of harmonic balance.
#pragma once

#include <vector>

#include "solver/time_integration.hpp"

namespace microslip::tests {

inline solver::TimePoint steady_state(const solver::Scene& scene, double frequency,
                                      const solver::TimeOptions& options) {
  const solver::TimeSystem system(scene, frequency);
  solver::TimeState state = solver::state_at_rest(system);
  return solver::integrate_to_steady_state(system, options, state);
}

inline solver::TimePoint steady_state_from(const solver::Scene& scene, double frequency,
                                           const contact::Harmonics& q,
                                           const solver::TimeOptions& options) {
  const solver::TimeSystem system(scene, frequency);
  solver::TimeState state = solver::state_on(system, q);
  return solver::integrate_to_steady_state(system, options, state);
}

/// The first from rest, each other from the last state of the one before: what a slow sweep finds.
inline std::vector<solver::TimePoint> swept_states(const solver::Scene& scene,
                                                   const std::vector<double>& frequencies,
                                                   const solver::TimeOptions& options) {
  std::vector<solver::TimePoint> points;
  solver::TimeState state;
  for (const double frequency : frequencies) {
    const solver::TimeSystem system(scene, frequency);
    if (points.empty()) state = solver::state_at_rest(system);
    points.push_back(solver::integrate_to_steady_state(system, options, state));
  }
  return points;
}

}  // namespace microslip::tests
