/// @file
/// Harmonics that a solution begins with, before any are chosen for it.
#pragma once

#include "solver/balance/harmonic_set.hpp"
#include "solver/continuation_options.hpp"
#include "solver/scene.hpp"

namespace microslip::solver {

/// What every motion has: the first harmonic and those of the excitation.
[[nodiscard]] HarmonicSet least_harmonics(const Scene& scene);

/// What a curve, or the choice of its harmonics, begins with.
[[nodiscard]] HarmonicSet first_harmonics(const Scene& scene, const ContinuationOptions& options);

}  // namespace microslip::solver
