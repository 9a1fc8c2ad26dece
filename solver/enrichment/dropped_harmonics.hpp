/// @file
/// What taking a harmonic out of a solved peak would do to it: the force on the rows of k that
/// brings x^(k) to zero, with the response of all the others to it,
///
///   [R_q  R_ω; cᵀ] δ = [f on the rows of k; 0],     δ^(k) = −x^(k),      δA = A_q δ
///
/// c the tangent of the branch, or (0, 1) at an end of the range.
#pragma once

#include <vector>

#include "solver/peak/local_peak.hpp"

namespace microslip::solver {

struct DroppedHarmonic {
  int order = 0;
  double amplitude = 0.0;  ///< δA / A, signed
};

/// @param peak  solved with `balance`.
/// @return all orders of the set, those that do least first; infinite where it cannot be told.
[[nodiscard]] std::vector<DroppedHarmonic> dropped_harmonics(HarmonicBalance& balance,
                                                             const LocalPeak& peak);

}  // namespace microslip::solver
