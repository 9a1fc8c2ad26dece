/// @file
/// A response curve whose harmonics are chosen for it (enrichment/curve_harmonics.hpp).
#pragma once

#include "solver/continuation.hpp"

namespace microslip::solver {

/// As trace_response(), or solve_at_frequency() where the range is one frequency.
/// @param options  with `harmonic_tolerance` > 0.
/// @param observe  sees the points of the curve that is given,
///                 not those of the one it is chosen from.
[[nodiscard]] ResponseCurve trace_choosing(const Scene& scene, const ContinuationOptions& options,
                                           const PointObserver& observe);

}  // namespace microslip::solver
