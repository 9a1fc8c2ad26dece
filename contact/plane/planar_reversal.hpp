/// @file
/// Where within a step of slip the slider stops: the first fraction at which the slip rate ρ falls
/// to 0.
///
/// ρ is known at the nodes of the step. Between them it is followed by the polynomial through
/// these, and seen again where that has a minimum: ρ may fall below 0 and rise again between two
/// nodes. Where a step ends at an end of its interval and μ depends on the rate, ρ may turn within
/// a layer there, far thinner than a cell of nodes: it is looked at ever closer to that end.
///
/// Source: theory sections 9, 10.
#pragma once

#include "contact/plane/planar_intervals.hpp"
#include "contact/plane/planar_slip.hpp"

namespace microslip::contact {

/// ρ at begin + x · length of a solved step, x in [0, 1], / L₀.
[[nodiscard]] double slip_rate_at(const PlanarMotion& motion, const SlipStep& step, double x);

/// @param step  solved, inside the interval.
/// @return fraction of the step; above 1 if ρ does not fall to 0.
[[nodiscard]] double first_reversal(const PlanarMotion& motion, const PlanarInterval& interval,
                                    const SlipStep& step);

}  // namespace microslip::contact
