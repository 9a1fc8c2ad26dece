/// @file
/// One set of harmonics for the peaks of a family of scenes. A search over a parameter compares peaks to
/// rounding, so that a set which changes from scene to scene would show as steps; instead all have what the
/// peaks of a few of them need.
#pragma once

#include <vector>

#include "solver/optimum/peak_trace.hpp"

namespace microslip::solver {

/// @param values  of the parameter, whose peaks choose (enrichment/curve_harmonics.hpp).
/// @param work    what that costs is added.
/// @return `range` with the harmonics of all their peaks, and of the largest amplitude where that is at an
///         end, given; unchanged where they are given already.
[[nodiscard]] ContinuationOptions with_common_harmonics(const SceneFamily& family,
                                                        const std::vector<double>& values,
                                                        const ContinuationOptions& range,
                                                        PeakWork& work);

/// What the harmonics of a peak leave out, over its amplitude; harmonics are chosen by `range`.
[[nodiscard]] double left_out_at(const Scene& scene, const ResponsePoint& peak,
                                 const ContinuationOptions& range);

}  // namespace microslip::solver
