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
/// A row is written if its proof meets its gates: the residual the tolerance asked for, both works
/// 1e-10, the events of each point follow one another. Where the works differ by more, no more than
/// this is let through:
///
///   ε P T                      rounding, P = π Σ_k k |A_k|, T the largest terms of the equations
///   P |R|                      of the energy: what the residual left does
///   ModalForce::work_error     of the dissipation: what the law of the contact promises,
///                              and P times what its method says the force may be off by
///
/// The branch goes on along dx/dω = −(∂R/∂x)⁻¹ ∂R/∂ω: that gives the slopes of the output.
#pragma once

#include <string>

#include "solver/balance/newton.hpp"
#include "solver/response_curve.hpp"
#include "solver/stability/stability.hpp"

namespace microslip::solver {

/// @param frequency  ω of `solution` [rad/s].
[[nodiscard]] ResponsePoint certified_point(HarmonicBalance& balance, const NewtonResult& solution,
                                            double frequency, const StabilityReport& stability);

/// Of works that are exchanged: rounding of common sums.
inline constexpr double customary_imbalance = 1e-10;

/// What a row may have at most, each as the value of ResponsePoint it is for.
struct Gates {
  double residual = 0.0;
  double energy = 0.0;
  double dissipation = 0.0;
  double events = 0.0;  ///< CycleReport::event_gap [rad]
};

/// @param asked_residual  > 0.
[[nodiscard]] Gates gates_of(HarmonicBalance& balance, const ResponsePoint& point,
                             double asked_residual);
/// What a point does not meet, with the numbers; empty: it is certified.
[[nodiscard]] std::string objection(const ResponsePoint& point, const Gates& gates);

enum class Held { frequency, place_on_the_branch };

/// A solution that is not closely enough one for its gates, solved again until rounding is left.
/// @param held  the place where the solution has factors, else the frequency.
/// @return  the same where nothing is gained; `evaluations` are those that this took.
[[nodiscard]] NewtonResult solved_closer(HarmonicBalance& balance, const NewtonResult& solution,
                                         Held held);

}  // namespace microslip::solver
