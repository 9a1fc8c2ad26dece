/// @file
/// All sign changes of a trigonometric polynomial in a period.
///
/// They are isolated, not looked for: on a cell of width d the cubic through values and slopes
/// at its ends misses p by no more than M d⁴/384, its derivatives by √3 M d³/216 and M d²/12, with
/// M = Σ h⁴ |C_h| ≥ |p⁗|. A cell is done when these bounds prove that p keeps its sign, or its
/// slope does, or its curvature does; else it is halved. Pairs of sign changes however close are
/// found, down to rounding of p.
///
/// The constants are those of a quartic, p⁗ = M, the worst case of cubic Hermite interpolation.
#pragma once

#include <vector>

#include "contact/numerics/trigonometric_polynomial.hpp"

namespace microslip::contact {

/// Where p > 0 begins (rising) or ends.
struct SignChange {
  double phase = 0.0;  ///< in [0, 2π]
  bool rising = false;
};

/// All phases at which the answer to p > 0 changes, in order;
/// up and down alternate around the period.
/// @param changes  written whole; storage is used again.
/// @note To rounding of p, 1e-15 of |p₀| + Σ |C_h|: where p only just passes zero within that, it
///       touches and does not change. None for coefficients so large that Σ h⁴ |C_h| is not finite.
void find_sign_changes(const TrigonometricPolynomial& p, std::vector<SignChange>& changes);

}  // namespace microslip::contact
