/// @file
/// A converged iterate becomes a point of a response curve, with its proof (theory section 15.3):
///
///   W_exc  = π Σ_k k (A_s·F_c − A_c·F_s)        work of the excitation per period
///   W_damp = π ω Σ_k k² Σ_n 2ζ_n ω_n |A_n|²     viscous damping
///   W_fric = π Σ_k k (A_s·G_c − A_c·G_s)        contact, from the Fourier coefficients
///
/// energy imbalance |W_exc − W_damp − W_fric|, dissipation mismatch |W_fric − ∬∮ μn|ds| dA|, both
/// relative to max(|W_exc|, W_damp + W_fric). Both are 0 where all of them vanish: to rounding of
/// the motion times the excitation, and wherever there is none.
///
/// The branch goes on along dx/dω = −(∂R/∂x)⁻¹ ∂R/∂ω: that gives the slopes of the output.
#pragma once

#include "solver/balance/newton.hpp"
#include "solver/response_curve.hpp"
#include "solver/stability/stability.hpp"

namespace microslip::solver {

/// @param frequency  ω of `solution` [rad/s].
[[nodiscard]] ResponsePoint certified_point(HarmonicBalance& balance, const NewtonResult& solution,
                                            double frequency, const StabilityReport& stability);

}  // namespace microslip::solver
