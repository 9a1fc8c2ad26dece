/// @file
/// What a point does over the period of single-harmonic motion, without its forces: regime and
/// states at some instants, from the closed form of its phases.
#pragma once

#include "contact/closed_form/cycle_phases.hpp"
#include "contact/point/period_states.hpp"

namespace microslip::contact {

/// @param phases  cycle_phases() of the regime.
[[nodiscard]] CycleStates cycle_states(CycleRegime regime, const CyclePhases& phases);

}  // namespace microslip::contact
