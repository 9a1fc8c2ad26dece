/// @file
/// One set of harmonics for the peaks of a family of scenes. A search over a parameter compares
/// peaks to rounding, so that a set which changes from scene to scene would show as steps; instead
/// all have what the peaks of a few of them need.
#pragma once

#include <optional>
#include <vector>

#include "solver/optimum/peak_trace.hpp"

namespace microslip::solver {

/// @param values  of the parameter, whose peaks choose (enrichment/curve_harmonics.hpp).
/// @param work    what that costs is added.
/// @return `range` with the harmonics of all their peaks, and of the largest amplitude where that
///         is at an end, given; unchanged where they are given already.
[[nodiscard]] ContinuationOptions with_common_harmonics(const SceneFamily& family,
                                                        const std::vector<double>& values,
                                                        const ContinuationOptions& range,
                                                        PeakWork& work);

/// What a peak asks for beyond harmonics that peaks at other values have chosen.
struct LackedHarmonics {
  ContinuationOptions range;  ///< with them as well, given
  double amplitude = 0.0;     ///< of the peak with all that it chooses itself
};

/// @param best   the highest peak at its value, solved for with the harmonics of `given`.
/// @param highest  of the curve there, which the choice begins with; nullptr: not known.
/// @param range  chooses harmonics.
/// @param work   what that costs is added.
/// @return empty: with those that it chooses itself it is as high, within the tolerance of `range`
///         or 1 %, or they are all given already, or are not found.
[[nodiscard]] std::optional<LackedHarmonics> lacked_harmonics(
    const SceneFamily& family, const PeakOfParameter& best, const ResponsePoint* highest,
    const ContinuationOptions& given, const ContinuationOptions& range, PeakWork& work);

/// What the harmonics of a peak leave out, over its amplitude; harmonics are chosen by `range`.
[[nodiscard]] double left_out_at(const Scene& scene, const ResponsePoint& peak,
                                 const ContinuationOptions& range);

}  // namespace microslip::solver
