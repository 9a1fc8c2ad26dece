/// @file
/// What a periodic motion means to one contact point before any state is known: the guards whose
/// signs decide states, trigonometric polynomials of the harmonics of the motion (theory sections
/// 3, 8).
///
///   spring  k_u (u − u₀)            load  n₀' + k_v v, means included, negative where separated
///   w_P = spring − μ load + μ n₀    w_N = spring + μ load − μ n₀       (no means)
#pragma once

#include "contact/harmonics.hpp"
#include "contact/numerics/trigonometric_polynomial.hpp"
#include "contact/surface/point_parameters.hpp"

namespace microslip::contact {

struct EventGuards {
  TrigonometricPolynomial spring;
  TrigonometricPolynomial load;
  TrigonometricPolynomial positive;       ///< w_P
  TrigonometricPolynomial negative;       ///< w_N
  TrigonometricPolynomial positive_rate;  ///< dw_P/dθ
  TrigonometricPolynomial negative_rate;  ///< dw_N/dθ
  double limit = 0.0;                     ///< q = μ n₀
  double spring_mean = 0.0;               ///< k_u u₀
};

/// @param motion  column 0 is u, column 1 is v.
/// @param guards  written whole; storage is used again.
void set_event_guards(const PointParameters& point, const Harmonics& motion, EventGuards& guards);

}  // namespace microslip::contact
