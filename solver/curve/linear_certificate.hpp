/// @file
/// Proof that a linear limit solves the nonlinear equations over a whole frequency range, so that
/// no nonlinear solver is needed. The linear response at a frequency is checked against the
/// conditions of contact; between frequencies it is enclosed.
/// With D(ω) = K − ω² + iωC and A = D⁻¹Q, on |ω − ω_m| ≤ h, by sums over modes, which
/// are cheap and rough (modal_enclosure.hpp); where these do not do by the inverse in the middle:
///
///   A = A_m − D_m⁻¹ [D(ω) − D_m] A,      |D(ω) − D_m| ≤ e = 2ω_m h + h² + h c     (per mode)  (1)
///   M = G (diag(e) + r),     G = |D_m⁻¹|,     r rounding of D_m                              (2)
///   |A − A_m| ≤ t     where     M |A_m| + rounding + M t ≤ t                                 (3)
///
/// where the norm of M is below one; else, and where the conditions are not met all over
/// the enclosure, the interval is halved. The proof is of *a* solution; others may coexist (a gap
/// that a strong enough vibration would close).
#pragma once

#include "contact/modal_force.hpp"
#include "solver/balance/harmonic_balance.hpp"

namespace microslip::solver {

struct LinearCertificate {
  contact::LinearState state = contact::LinearState::unknown;
  int n_intervals = 0;  ///< frequency intervals that the proof, or the attempt, looked at
};

/// @param low, high  of the frequency [rad/s], 0 < low ≤ high.
/// @return unknown: not proved. Forces beyond the first harmonic, and forces that offer no
///         bounds, never are.
[[nodiscard]] LinearCertificate certify_linear(const HarmonicBalance& balance, double low,
                                               double high);

}  // namespace microslip::solver
