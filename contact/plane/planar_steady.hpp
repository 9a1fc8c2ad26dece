/// @file
/// The steady cycle of a planar slider: the orbit that ends where it began.
///
/// With separation one period from touch-down is exact. Else the virgin slider is walked through
/// one period; if it slips, the least excess of any slider over the ellipses of all phases tells
/// what becomes of it (planar_rest.hpp):
///
/// Rest is possible: the slider is pushed into the ellipses period by period. Where it comes to
/// rest is history (theory sections 4.2, 9) and marched without help, except where two windows push
/// it in turn: then it goes to their corner at once (planar_corner.hpp).
///
/// Rest is not possible: the cycle is unique, and Newton's method finds it as the fixed point Φ(s)
/// = s of the period map, with its derivative M,
///
///   s ← s + (I − M)⁻¹ (Φ(s) − s)                                                               (1)
///
/// kept while these steps or the moves Φ(s) − s shrink, else s ← Φ(s).
///
/// Next to the onset of slip the slider of least excess is where it begins, and Φ(s) − s is summed
/// from the slip of the period, not from two positions: I − M is as small as that slip, and both
/// keep their digits. The size of the step in (1) estimates the distance from the fixed point; it
/// judges and ends the iteration.
///
/// Source: theory section 9.
#pragma once

#include <optional>

#include "contact/plane/planar_corner.hpp"
#include "contact/plane/planar_orbit.hpp"
#include "contact/plane/planar_variation.hpp"

namespace microslip::contact {

struct SteadyOrbit {
  CycleRegime regime = CycleRegime::separated;
  PlanarOrbit orbit;
  std::vector<PlanarOrbit>
      history;  ///< full stick: periods before the last, from the virgin slider; none at a corner
  std::optional<SliderCorner> corner;  ///< full stick: the corner the slider was pushed into
  double defect = 0.0;                 ///< estimated distance from the fixed point, in f / F₀
  /// Whether the period ends where it began to the last bits of its slip, or slips by rounding
  /// alone: nothing is left to iterate, however ill the fixed point is determined.
  bool closes = true;
};

[[nodiscard]] SteadyOrbit steady_orbit(const PlanarMotion& motion,
                                       const std::vector<PlanarInterval>& intervals,
                                       const OrbitOptions& options);

/// Derivatives of the friction of a steady orbit by its parameters, memory included.
struct SteadyDerivative {
  Eigen::MatrixXd first;   ///< ∂f_p, (2H+1) × (3(2H+1) + 1): harmonics of the motion, then ω
  Eigen::MatrixXd second;  ///< ∂f_r
};
[[nodiscard]] SteadyDerivative steady_derivative(const PlanarMotion& motion,
                                                 const SteadyOrbit& steady);

}  // namespace microslip::contact
