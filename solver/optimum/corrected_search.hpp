/// @file
/// The best value of a parameter with many harmonics, out of peaks that few of them have followed
/// and that are corrected at a few values (corrected_peaks.hpp).
///
/// The minimum of the corrected peaks is solved for as one value more, until it stays where a value
/// is; likewise, where peaks can be carried, both ends of the interval that is as good to 1 %, and
/// neighbours on both sides. The whole curve at the best value, with all harmonics, must have no
/// higher peak.
///
/// A peak carried from a branch that few harmonics have found beside their curve counts like one of
/// the curve; where they have found none, none is looked for with all harmonics.
///
/// What does not go this way is left to a search that follows peaks with all harmonics: curves that
/// are incomplete, a minimum at a bound, one that does not settle.
#pragma once

#include <optional>

#include "solver/optimum.hpp"

namespace microslip::solver {

struct CorrectedSearch {
  std::optional<Optimum> optimum;  ///< found, or out of time with the lowest value so far
  /// The highest point of the curve at the best value.
  std::optional<ResponsePoint> highest;
  int n_curves = 0;  ///< traced whole
  /// What the search has cost beside that of the peaks with few harmonics; of `optimum` too.
  PeakWork work;
};

/// @param few       with peaks followed by search_followed(); more are followed.
/// @param family    that of `few`.
/// @param range     with all harmonics, given.
/// @param options   bounds about the best value with few harmonics; `search_starts` of curves.
/// @param believed  best value with few harmonics.
[[nodiscard]] CorrectedSearch search_corrected(PeakFamilies& few, const SceneFamily& family,
                                               const ContinuationOptions& range,
                                               const OptimumOptions& options, double believed);

}  // namespace microslip::solver
