/// @file
/// A peak as exactly as its amplitude needs: the branch is followed uphill until
///
///   |da/ds| ≤ 1e-4 a,      s the arc length in scaled variables, in which the peak's curvature is
///                          of order a,
///
/// so that a errs by some 1e-8. The slope is driven to zero by secants, bracketed where it jumps.
/// Peaks that are printed are solved for to rounding (special_points.hpp); this one costs a third.
#pragma once

#include <optional>

#include "solver/peak/local_peak.hpp"

namespace microslip::solver {

/// @param start  a place in the unknowns of `balance`, with the tangent to leave it along; at an
///               end of the range its frequency stays.
/// @param range  a peak outside of its frequencies is none.
/// @param farthest  way along the branch, in amplitudes or widths of the resonance.
/// @return empty: Newton's method failed, or the peak is farther away.
[[nodiscard]] std::optional<LocalPeak> level_point(HarmonicBalance& balance, const LocalPeak& start,
                                                   const ContinuationOptions& range, PeakWork& work,
                                                   double farthest);

}  // namespace microslip::solver
