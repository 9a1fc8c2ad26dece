/// @file
/// Proof that a patch answers every motion of a set like a linear spring through the origin: all points
/// stuck, or all of them open, throughout the period (theory section 4.1), and none of them with a mean
/// force beyond that of its springs:
///
///   stuck   n₀' ≥ 0 and as in sleeping_points.hpp (1)      force k_u u, k_v v, means too
///   open    n₀' ≤ 0 and as in sleeping_points.hpp (2)      force 0
///
/// A preload that the mean motion takes away, or a gap that it closes, leaves a constant force: unknown.
/// Points that exert no dynamic force at all (k_v = 0 with μ = 0 or k_u = 0) do not count.
#pragma once

#include "contact/contact_patch.hpp"
#include "contact/modal_force.hpp"

namespace microslip::contact {

/// For the closed form of one tangential direction.
/// @param centre  one harmonic [m√kg].
/// @param radius  the set: ‖Δx‖ from the centre over all modal unknowns [m√kg], ≥ 0.
/// @throws std::invalid_argument  another number of harmonics or modes.
[[nodiscard]] LinearState linear_state(const ContactPatch& patch, const ModalShapes& shapes,
                                       const Harmonics& centre, double radius);

}  // namespace microslip::contact
