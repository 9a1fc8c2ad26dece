/// @file
/// The friction cycle of one point by another road than the closed form: the slider is marched in
/// time from rest for two periods, transitions are found by sampling the guards of the state held
/// and bisecting, the second period is integrated by Gauss–Legendre quadrature; all in extended
/// precision. Knows only the laws n = max(0, n₀ + k_v v), |f| ≤ μ n, f = k_u (u − s).
#pragma once

#include <string>

#include "contact/closed_form/friction_cycle.hpp"

namespace microslip::test {

struct ReferenceCycle {
  long double friction[3] = {};  ///< mean, sin θ, cos θ
  long double normal[3] = {};
  long double dissipated_energy = 0.0L;  ///< ∫ μ n |ds|
  long double slip_distance = 0.0L;
  std::string
      sequence;  ///< states over one period beginning after a separation (if any), e.g. "SPSE"
};

/// @throws std::runtime_error  the march does not end (a fault of the reference).
[[nodiscard]] ReferenceCycle reference_cycle(const contact::PointParameters& point,
                                             const contact::PointMotion& motion);

}  // namespace microslip::test
