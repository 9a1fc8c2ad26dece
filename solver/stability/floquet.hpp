/// @file
/// Floquet multipliers of a periodic motion from its period map in time (theory section 17).
///
///   x ↦ P(x), x = (q, q̇, sliders that move within the period, directions of slip),   M = ∂P/∂x
///
/// by event-located integration: where held forces are linear of one period and its variations
/// (period_variation.hpp), else by central differences of it. Unlike the Jacobian of the balance,
/// which answers perturbations of the period of the motion alone, P sees every perturbation with
/// its own history of the sliders: its pairs of multipliers are those of the motion. A point that
/// never slips nor separates keeps its slider, a multiplier of 1 that tells nothing,
/// and is left out.
///
/// The motion given is a truncated series, hence not quite periodic:
/// M is that of a motion `distance` away.
#pragma once

#include <Eigen/Core>

#include "solver/scene.hpp"

namespace microslip::solver {

struct FloquetMultipliers {
  /// Empty: not known, because a perturbed period ended in other states or could not be integrated,
  /// or the matrix would have been larger than allowed.
  Eigen::VectorXcd multipliers;
  /// ‖P(x) − x‖ of the motion linearised about, over the largest motion of the period.
  double distance = 0.0;

  [[nodiscard]] bool known() const { return multipliers.size() > 0; }
  /// Largest |μ| of those that are not real and positive: pairs, and period doubling. 0:
  /// there are none.
  [[nodiscard]] double largest_oscillating() const;
};

/// @param scene      with `transient`, or linear.
/// @param frequency  ω [rad/s].
/// @param q          harmonics of a solution.
/// @param most       rows of M at most; beyond, M is not made. Where it is differenced each costs
///                   two periods, and rows times points are at most 600.
[[nodiscard]] FloquetMultipliers floquet_multipliers(const Scene& scene, double frequency,
                                                     const Harmonics& q, Eigen::Index most);

}  // namespace microslip::solver
