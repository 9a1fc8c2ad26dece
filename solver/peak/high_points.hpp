/// @file
/// What can be the largest amplitude of a response curve: its peaks, the ends of the frequency
/// range, and points higher than their neighbours that the curve passes without having solved for a
/// peak. The last are climbed from (local_peak.hpp); only where that finds no peak they stay as
/// they are, unsolved.
#pragma once

#include <vector>

#include "solver/peak/local_peak.hpp"
#include "solver/response_curve.hpp"

namespace microslip::solver {

struct HighPoint {
  ResponsePoint point;
  PeakPlace place = PeakPlace::peak;
  bool climbed = false;   ///< a peak that the curve itself lacks
  bool detached = false;  ///< on a branch that the sweep does not meet
};

/// Of the curve and of the detached branches that a search has found beside it.
/// @param curve  of `scene` over `range`, harmonics given; may be incomplete.
/// @return from the highest down; equal ones in the order of the curve.
[[nodiscard]] std::vector<HighPoint> high_points(const Scene& scene, const ResponseCurve& curve,
                                                 const ContinuationOptions& range);

/// What is told of the curve itself: its highest peak, without one its highest end of the range;
/// what stopped somewhere has neither. @return in `high`, or nullptr.
[[nodiscard]] const HighPoint* highest_of_curve(const std::vector<HighPoint>& high);

}  // namespace microslip::solver
