/// @file
/// What a single-harmonic motion means to one contact point before any state is known: the two slip
/// functions, the normal load and how far both are from the limits between regimes (theory
/// section 4).
///
///   w_P = k_u u − μ k_v v = L₁ cos(θ − θ_P)            maximum at θ_P: end of positive slip
///   w_N = k_u u + μ k_v v = −L₂ cos(θ − θ_N)           minimum at θ_N: end of negative slip
///   n₀ + k_v v            = n₀ + B cos(θ − δ),          n₀ = n₀' + k_v v₀,  q = μ n₀
///
/// Angles are carried as directions (sin, cos), so nothing is divided by sin φ and no branch of an
/// arctangent has to be chosen. Close to a limit (grazing contact, onset of slip, L₁ or L₂ → 0) the
/// differences are formed in quadruple precision: the forces would not need it, their derivatives,
/// which have roots of these differences, do.
#pragma once

#include "contact/closed_form/friction_cycle.hpp"

namespace microslip::contact {

/// An angle as the point on the unit circle.
struct Direction {
  double sin = 0.0;
  double cos = 1.0;
};

struct SlipFunctions {
  double bias_load = 0.0;       ///< n₀
  double load_amplitude = 0.0;  ///< B ≥ 0
  double above_open = 0.0;      ///< B + n₀; ≤ 0: separated for good
  double below_closed = 0.0;    ///< B − n₀; ≤ 0: never separated
  double limit = 0.0;           ///< q
  double positive = 0.0;        ///< L₁ ≥ 0
  double negative = 0.0;        ///< L₂ ≥ 0
  double difference = 0.0;      ///< L₂ − L₁
  double excess = 0.0;          ///< L₁ + L₂ − 2q; ≤ 0 (and never separated): full stick
  double rest_positive = 0.0;   ///< 2q − ΔL: what the excess lacks of 2 L₁
  double rest_negative = 0.0;   ///< 2q + ΔL: what the excess lacks of 2 L₂
  Direction end_of_positive;    ///< θ_P
  Direction end_of_negative;    ///< θ_N
  Direction largest_load;       ///< δ
};

/// Everything above for one point; no state is decided here.
[[nodiscard]] SlipFunctions slip_functions(const PointParameters& point, const PointMotion& motion);

}  // namespace microslip::contact
