/// @file
/// Proof that a patch answers every motion of a set like a linear spring (theory section 4.1): all points
/// stuck, or all of them open, throughout the period.
///
///   stuck   n₀' ≥ 0,  n₀ ≥ B,  L₁ + L₂ ≤ 2q,  L₂ − q ≤ k_u u₀ ≤ q − L₁      force k_u u, k_v v, means too
///   open    n₀' ≤ 0,  n₀ + B ≤ 0                                            force 0
///
/// n₀ = n₀' + k_v v₀. Amplitudes are bounded by the triangle inequality, |Σ φ_n A_n| ≤ |Σ φ_n Ã_n| +
/// Σ |φ_n| r_n, with Ã the centre of the set and r its radii. A point without friction (μ = 0 or k_u = 0)
/// needs the conditions on the load only, one without normal stiffness as well none at all.
#pragma once

#include "contact/contact_patch.hpp"
#include "contact/modal_force.hpp"

namespace microslip::contact {

/// For the closed-form law of one tangential direction.
/// @param centre  one harmonic [m√kg].
/// @param radius  of the complex amplitude of every mode [m√kg], n_modes, ≥ 0; the means are exact.
/// @throws std::invalid_argument  another number of harmonics or modes.
[[nodiscard]] LinearState linear_state(const ContactPatch& patch, const ModalShapes& shapes,
                                       const Harmonics& centre, const Eigen::VectorXd& radius);

}  // namespace microslip::contact
