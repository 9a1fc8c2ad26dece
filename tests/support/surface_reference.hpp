/// @file
/// Reference for cycles of one tangential direction with any surface law (surface_line_events.hpp):
/// theory sections 3, 8, 10, 11 in extended precision, with its own laws and no part of the
/// library.
///
/// The period is cut where the motion turns or nearly does, where the load has its kinks, and on
/// both sides of all these in steps that shrink geometrically down to rounding, so that no layer of
/// the rate or of the heights is missed. On a cut every extremum of an end of the band is bracketed
/// by the sign of its derivative, minima of the derivative included, and found by bisection. The
/// slider is marched over two periods from the virgin position; the second is integrated with
/// twenty Gauss–Legendre points a cut.
#pragma once

#include <string>
#include <vector>

#include "contact/harmonics.hpp"
#include "contact/patch/contact_patch.hpp"
#include "contact/surface/surface_law.hpp"

namespace microslip::test {

enum class ReferenceRate { constant, exponential, hyperbolic };
enum class ReferenceHeights { none, cubic, gaussian };

/// What a SurfaceLaw is made of.
struct ReferenceLaw {
  contact::PointParameters point;  ///< its friction coefficient is μ₀
  ReferenceRate rate = ReferenceRate::constant;
  double at_speed = 0.0;  ///< μ∞
  double decay = 0.0;     ///< λ or p [s/m]
  ReferenceHeights heights = ReferenceHeights::none;
  double mean = 0.0;       ///< of the heights [m], R/2
  double deviation = 0.0;  ///< [m], R/√20
  double height = 0.0;     ///< R [m]
  contact::SeriesCompliance series;

  [[nodiscard]] contact::SurfaceLaw law() const;
  [[nodiscard]] double largest_coefficient() const;
};

struct SurfaceReference {
  std::vector<long double> friction;  ///< mean, sin, cos, sin 2, …
  std::vector<long double> normal;
  long double dissipated_energy = 0.0L;  ///< ∮ μ n |ds|
  long double slip_distance = 0.0L;
  long double largest_load = 0.0L;
  std::string sequence;  ///< of states: S P N E
};

[[nodiscard]] SurfaceReference surface_reference(const ReferenceLaw& law,
                                                 const contact::Harmonics& motion, double frequency,
                                                 int n_harmonics);

}  // namespace microslip::test
