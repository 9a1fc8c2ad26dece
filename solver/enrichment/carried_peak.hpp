/// @file
/// A peak with more harmonics, from the same peak with few.
#pragma once

#include <optional>

#include "solver/balance/harmonic_set.hpp"
#include "solver/peak/local_peak.hpp"
#include "solver/scene.hpp"

namespace microslip::solver {

/// From the embedding, to the precision of level_point.hpp; in halves of the harmonics that are
/// missing, the lowest first, where the way is too long for Newton's method.
/// @param peak   solved with `from`; an end of the range stays one.
/// @param range  a peak outside of its frequencies is none.
/// @param work   what that costs is added.
/// @return empty: it is not found from there.
[[nodiscard]] std::optional<LocalPeak> carried_peak(const Scene& scene,
                                                    const ContinuationOptions& range,
                                                    const LocalPeak& peak, const HarmonicSet& from,
                                                    const HarmonicSet& to, PeakWork& work);

}  // namespace microslip::solver
