/// @file
/// What a point does over the period of single-harmonic motion, without its forces: regime and states at
/// some instants, from the closed form of its phases (cycle_phases.hpp). Slip without force, μ k_u = 0, counts
/// as stick.
#pragma once

#include "contact/closed_form/friction_cycle.hpp"
#include "contact/point/period_states.hpp"

namespace microslip::contact {

/// @param point   constants, in the ranges of ContactPatch.
/// @param motion  finite; forces below 1e-150 of a unit are not told from none.
[[nodiscard]] CycleStates cycle_states(const PointParameters& point, const PointMotion& motion);

}  // namespace microslip::contact
