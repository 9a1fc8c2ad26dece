/// @file
/// Stability of a solution by its slow flow (theory section 17): amplitudes vary slowly against the
/// cycle, so that the steady-cycle force applies,
///
///   B̈ + C Ḃ + Ω B + G_b = Q_b,      (2ikωI + C) Ȧ^(k) + (Ω − k²ω² + ikωC) A^(k) + G^(k) = Q^(k)
///
/// linearised with the Jacobian of the balance. Stable: no eigenvalue that is slow against the cycle
/// (|Im λ| < ω/4) grows, and det ∂R/∂x, whose sign changes at folds and simple branch points, is not
/// negative.
#pragma once

#include <Eigen/Core>

#include "solver/harmonic_balance.hpp"
#include "solver/response_curve.hpp"

namespace microslip::solver {

struct StabilityReport {
  Stability stability = Stability::not_assessed;
  double determinant_sign = 0.0;  ///< of ∂R/∂x: 1, −1, or 0 where it is singular
  double growth = 0.0;            ///< largest real part of the slow eigenvalues [rad/s], −∞: there is none
  /// How near, in frequency, a resonance of the linearised structure is, or how wide [rad/s].
  double nearest = 0.0;
};

[[nodiscard]] StabilityReport assess_stability(const HarmonicBalance& balance,
                                               const Eigen::MatrixXd& jacobian, double frequency);

}  // namespace microslip::solver
