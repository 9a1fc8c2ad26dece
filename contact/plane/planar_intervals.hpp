/// @file
/// The period of a planar cycle cut where the load, and with it the limit of friction, has a kink:
/// touch-down, lift-off and the kinks of a rough law. None of this depends on the slider.
///
/// Crossings of v(θ) with a kink are sign changes of a trigonometric polynomial (sign_changes.hpp):
/// none is missed. Instants are 24 per harmonic, and ever closer where the load nearly vanishes.
///
/// Source: theory sections 3, 8.
#pragma once

#include <vector>

#include "contact/plane/planar_motion.hpp"

namespace microslip::contact {

/// Part of the period in which everything a slider sees is smooth.
struct PlanarInterval {
  double begin = 0.0;  ///< [rad], may lie beyond 2π
  double end = 0.0;
  bool in_contact = false;
  bool touches_down = false;  ///< contact that follows a separated interval
  /// Instants from begin to end; both ends with the derivatives of their inner side. Empty where
  /// separated.
  std::vector<PlanarInstant> grid;

  /// Step to the inside that tells the sides of a kink apart.
  [[nodiscard]] double nudge() const;
};

/// Intervals in order of time over one period: from the first touch-down if there is one,
/// else from 0.
[[nodiscard]] std::vector<PlanarInterval> planar_intervals(const PlanarMotion& motion);

}  // namespace microslip::contact
