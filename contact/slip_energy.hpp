/// @file
/// Work and distance of the slip phases of a cycle (theory section 7).
///
/// On its way to the extremum θ_k of its slip function the slider moves at k_u |ds/dθ| = L sin x, with
/// x = |θ_k − θ| the angle that remains, so that
///
///   ∫ n |ds| = (L/k_u) [ (n₀ (1 − cos x) + ½ a sin²x − ½ r (x − sin x cos x)) ] between begin and end,
///
/// a = k_v v(θ_k), r = k_v v̇(θ_k); nothing cancels in short phases.
#pragma once

#include "contact/cycle_phases.hpp"
#include "contact/slip_functions.hpp"

namespace microslip::contact {

struct SlipEnergy {
  double normal_slip = 0.0;  ///< ∮ n |ds| in contact [Pa·m]
  double distance = 0.0;     ///< ∮ |ds| in contact [m]
};

/// @param point  k_u > 0.   @param w, phases  of the same point and motion.
[[nodiscard]] SlipEnergy slip_energy(const PointParameters& point, const PointMotion& motion,
                                     const SlipFunctions& w, const CyclePhases& phases);

}  // namespace microslip::contact
