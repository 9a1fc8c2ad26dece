/// @file
/// The steady cycle of a planar slider: the orbit that ends where it began.
///
/// With separation one period from touch-down is exact. Else the period map Φ of the slider is
/// non-expansive; from the virgin slider it is iterated, and helped by Newton's method on Φ(s) = s with
/// its derivative M once two periods have passed:
///
///   s ← s + (I − M)⁻¹ (Φ(s) − s),   kept while these steps or the moves Φ(s) − s shrink, else s ← Φ(s)  (1)
///
/// Φ(s) − s is summed from the slip of the period, not from two positions: near the onset of slip I − M is
/// as small as that slip, and both keep their digits.
///
/// The size of the step in (1) estimates the distance from the fixed point; it judges and ends the
/// iteration. What a point that ends up stuck throughout reaches is history: the virgin slider pushed into
/// the ellipses of all phases (theory sections 4.2, 9). It is marched without help, except where two
/// windows push it in turn: then it goes to their corner at once (planar_corner.hpp).
///
/// Source: theory section 9.
#pragma once

#include <optional>

#include "contact/planar_corner.hpp"
#include "contact/planar_orbit.hpp"
#include "contact/planar_variation.hpp"

namespace microslip::contact {

struct SteadyOrbit {
  CycleRegime regime = CycleRegime::separated;
  PlanarOrbit orbit;
  std::vector<PlanarOrbit>
      history;  ///< full stick: periods before the last, from the virgin slider; none at a corner
  std::optional<SliderCorner> corner;  ///< full stick: the corner the slider was pushed into
  double defect = 0.0;                 ///< estimated distance from the fixed point, in f / F₀
  /// Whether the period ends where it began to the last bits of its slip, or slips by rounding alone: nothing
  /// is left to iterate, however ill the fixed point is determined.
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
