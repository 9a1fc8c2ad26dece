/// @file
/// Fourier coefficients of a steady cycle and their Jacobian, given its phases (theory sections 5,
/// 6).
///
/// Force is continuous at every transition, so the derivative of a coefficient is the integral of
/// the derivative: what is left beside the springs is the memory c of each stick phase, one number
/// that depends on the instant at which the phase began.
#pragma once

#include "contact/closed_form/cycle_phases.hpp"
#include "contact/closed_form/friction_cycle.hpp"
#include "contact/closed_form/slip_functions.hpp"

namespace microslip::contact {

/// @param w, regime, phases  of the same point and motion.
[[nodiscard]] CycleForce cycle_force(const PointParameters& point, const PointMotion& motion,
                                     const SlipFunctions& w, CycleRegime regime,
                                     const CyclePhases& phases);

}  // namespace microslip::contact
