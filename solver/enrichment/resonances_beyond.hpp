/// @file
/// Harmonics above all of a peak that resonate there, however high: one that meets a mode moves
/// the peak though its neighbours do nothing.
#pragma once

#include <vector>

#include "solver/balance/harmonic_balance.hpp"
#include "solver/peak/local_peak.hpp"

namespace microslip::solver {

/// Orders k above the set of a balance, up to `reach`, for which kω lies within three half
/// bandwidths of where a mode ψ_j may be, between free ω_j and stuck Ω_j, whose answer there to the
/// force of the contact
///
///   |ψ_j · G^(k)| / (2 ζ_j ω_j kω)
///
/// may be more than a share of the first harmonic or, in the output, of the amplitude, and whose
/// answer by one step with them is. Where no mode is near, that costs one force of the contact.
/// @param peak   solved with the set of `balance`.
/// @param least  share, > 0.
[[nodiscard]] std::vector<int> resonances_beyond(HarmonicBalance& balance, const LocalPeak& peak,
                                                 int reach, double least);

}  // namespace microslip::solver
