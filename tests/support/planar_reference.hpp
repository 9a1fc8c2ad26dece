/// @file
/// The planar friction cycle of one point by another road than the law: fixed steps in extended
/// precision, one implicit return f = (I + λK)⁻¹ f* per step with λ by bisection, trapezoidal
/// Fourier sums, and Richardson's extrapolation over three step sizes. Steps begin where contact
/// does; no other event is located. Knows only n = max(0, n₀ + k_v v), or a law of its own, |f| ≤ μ
/// n, f = K (x − s) and that s moves along f.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "contact/harmonics.hpp"
#include "contact/patch/contact_patch.hpp"

namespace microslip::test {

/// What a surface makes of approach and speed at one instant.
struct SurfaceMoment {
  long double gap_load = 0.0L;             ///< > 0 in contact
  long double limit = 0.0L;                ///< μ n
  std::array<long double, 2> stiffness{};  ///< along p, r
};

struct PlanarCase {
  contact::PointParameters point;
  double second_stiffness = 0.0;  ///< k_w
  contact::Harmonics motion;      ///< u, v, w
  /// Of approach and speed hypot(u', w') at ω = 1, in place of `point`; empty for smooth surfaces.
  std::function<SurfaceMoment(long double, long double)> surface;
};

struct PlanarReference {
  std::vector<long double> first;  ///< coefficients of f_p in the order of Harmonics, as the motion
  std::vector<long double> second;       ///< of f_r
  long double dissipated_energy = 0.0L;  ///< ∮ f · ds
  long double doubt =
      0.0L;  ///< largest change by the last extrapolation, or way still ahead of the slider
};

/// @param n_steps  per period in the coarsest of the three marches.
[[nodiscard]] PlanarReference planar_reference(const PlanarCase& c, int n_steps);

/// k a + μ max n of a case, over both directions.
[[nodiscard]] double planar_scale(const PlanarCase& c);

}  // namespace microslip::test
