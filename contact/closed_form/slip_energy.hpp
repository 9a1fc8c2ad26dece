/// @file
/// Work and distance of the slip phases of a cycle (theory section 7).
///
/// On its way to the extremum θ_k of its slip function the slider moves at k_u |ds/dθ| = L sin x,
/// with x = |θ_k − θ| the angle that remains, under the load n = n₀ + a cos x − r sin x, a = k_v
/// v(θ_k), r = k_v v̇(θ_k). About the middle x_m of the phase, y = x − x_m, the odd parts drop out:
///
///   n = n₀ + A cos y − S sin y,   A = a cos x_m − r sin x_m,   S = a sin x_m + r cos x_m
///   ∫ n |ds| = (L/k_u) ∫ { sin x_m [(n₀ + A) cos y − A (1 − cos y) cos y] − S cos x_m sin²y } dy
///
/// Nothing cancels in a short phase, wherever it lies: a point that slips just before it lifts off
/// does so far from its extremum.
#pragma once

#include "contact/closed_form/cycle_phases.hpp"
#include "contact/closed_form/slip_functions.hpp"

namespace microslip::contact {

struct SlipEnergy {
  double normal_slip = 0.0;  ///< ∮ n |ds| in contact [Pa·m]
  double distance = 0.0;     ///< ∮ |ds| in contact [m]
};

/// @param point  k_u > 0.   @param w, phases  of the same point and motion.
[[nodiscard]] SlipEnergy slip_energy(const PointParameters& point, const PointMotion& motion,
                                     const SlipFunctions& w, const CyclePhases& phases);

}  // namespace microslip::contact
