/// @file
/// One peak of a response curve as an unknown of its own, carried from scene to scene without the
/// rest of the curve. Response and frequency are solved for together,
///
///   R(x, ω; p) = 0,     da/ds = 0
///
/// a the output's amplitude, s the arc length of the branch: first R = 0 on the plane across the
/// branch at the peak known for another p, then a few steps uphill until da/ds changes sign, then
/// its zero between two points of the branch. da/ds jumps where the branch has a kink, so it is
/// bracketed, never differentiated. Folds next to the peak do not matter: the frequency is an
/// unknown, not a coordinate.
///
/// An end of the frequency range, where the largest amplitude may stand as well, is carried the
/// same way: R(x, ω_end; p) = 0.
#pragma once

#include <optional>

#include "solver/balance/newton.hpp"
#include "solver/continuation_options.hpp"
#include "solver/response_curve.hpp"

namespace microslip::solver {

/// Where a largest amplitude stands on a curve.
enum class PeakPlace {
  peak,       ///< da/ds = 0, solved for
  range_end,  ///< at an end of the frequency range
  unsolved    ///< the highest point known; the peak beside it was not found
};

/// A solved peak, or the solution at an end of the range, with what the next one starts from.
struct LocalPeak {
  BranchVector point;    ///< x, ω
  BranchVector tangent;  ///< of the branch, in scaled variables
  Scaling scaling;
  double amplitude = 0.0;             ///< [m]
  PeakPlace place = PeakPlace::peak;  ///< never unsolved
  bool rises = false;  ///< at an end of the range: the amplitude grows into the range
};

/// Work of following peaks.
struct PeakWork {
  long iterations = 0;
  long contact_evaluations = 0;
};

/// A peak of a curve as a place to start from. Empty: the branch has no tangent there.
[[nodiscard]] std::optional<LocalPeak> local_peak(HarmonicBalance& balance,
                                                  const ResponsePoint& peak);

/// The same of a solution at an end of the range.
[[nodiscard]] std::optional<LocalPeak> local_end(HarmonicBalance& balance, const ResponsePoint& end,
                                                 const ContinuationOptions& range);

/// The peak, or the solution at the end of the range, that `from` has become in another scene.
/// @param balance  of the other scene.
/// @param from     peak of a scene near by.
/// @param guess    expected place of the new peak.
/// @param range    a peak outside of its frequencies is none.
/// @return empty: no peak within half an amplitude, or half a resonance width, of the guess; it
///         vanished, left the range, or the step between the scenes is too long.
[[nodiscard]] std::optional<LocalPeak> follow_peak(HarmonicBalance& balance, const LocalPeak& from,
                                                   const BranchVector& guess,
                                                   const ContinuationOptions& range,
                                                   PeakWork& work);

}  // namespace microslip::solver
