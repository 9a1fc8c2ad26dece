/// @file
/// Harmonics that a curve lacks and that may resonate somewhere along it, away from the peaks that
/// its set was chosen for: with them it may have another peak there, higher than all.
#pragma once

#include <vector>

#include "solver/balance/harmonic_set.hpp"
#include "solver/continuation_options.hpp"
#include "solver/response_curve.hpp"
#include "solver/scene.hpp"

namespace microslip::solver {

/// Orders k beyond the set with kω = ω_j in the range, ψ_j and ω_j a mode of the structure, free or
/// stuck, whose resonant response to the force of the contact there
///
///   |ψ_j · G^(k)| / (2 ζ_j ω_j kω)
///
/// is more than the tolerance of the first harmonic of the curve's largest point, or moves the
/// output by more than that of its amplitude. Motions are interpolated between points of the curve.
/// @param range  `harmonic_tolerance` > 0, and `n_harmonics`, the highest that may be added.
[[nodiscard]] std::vector<int> resonances_along(const Scene& scene,
                                                const ContinuationOptions& range,
                                                const HarmonicSet& set, const ResponseCurve& curve);

}  // namespace microslip::solver
