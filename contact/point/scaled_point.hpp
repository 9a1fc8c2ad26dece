/// @file
/// A point in units of force near its own forces, a power of two away from those of the caller: nothing
/// under- or overflows on the way, and results are the same to the last bit in any such unit. Rough
/// surfaces, which have a length of their own, are left as they are.
#pragma once

#include "contact/point/point_law.hpp"
#include "contact/surface/surface_law.hpp"

namespace microslip::contact {

/// @param motion  u, v, w; finite.
struct ScaledPoint {
  ScaledPoint(const SurfaceLaw& surface, const Harmonics& motion, double frequency);

  /// Back to the units of the caller.
  void count_back(PointHistory& history) const;

  double unit = 1.0;  ///< in those of the caller, lengths and forces alike
  SurfaceLaw law;
  Harmonics motion;
  double frequency;  ///< so that speeds stay what they are
};

}  // namespace microslip::contact
