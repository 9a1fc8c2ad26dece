/// @file
/// The best value of a parameter by peaks that are followed over it (peak_trace.hpp): valleys are
/// searched until none is left that may hold the minimum, the lowest is confirmed by its curve.
#pragma once

#include "solver/optimum.hpp"

namespace microslip::solver {

/// Of the scale: tolerance for a valley that may not be the lowest.
constexpr double rough_search = 1e-2;

/// The peaks that a search begins with, none of them followed yet.
/// @param family  borrowed.
[[nodiscard]] PeakFamilies peaks_to_search(const SceneFamily& family,
                                           const ContinuationOptions& range,
                                           const OptimumOptions& options);

/// @param peaks  none followed yet; afterwards with all that the search has followed.
/// @param one_frequency  the range is a single one.
[[nodiscard]] Optimum search_followed(PeakFamilies& peaks, const OptimumOptions& options,
                                      bool one_frequency);

}  // namespace microslip::solver
