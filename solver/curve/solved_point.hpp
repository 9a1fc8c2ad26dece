/// @file
/// A solution at a fixed frequency as a point of a curve of its own, with its proof.
#pragma once

#include "solver/continuation_options.hpp"
#include "solver/response_curve.hpp"
#include "solver/scene.hpp"
#include "solver/balance/harmonic_balance.hpp"
#include "solver/balance/newton.hpp"

namespace microslip::solver {

/// The solution on a force that suits it (refit.hpp).
/// @param curve  takes the work and remedies; its points are left alone.
[[nodiscard]] ResponsePoint settled_point(const HarmonicBalance& balance, NewtonResult solution,
                                          const ContinuationOptions& options, ResponseCurve& curve);

}  // namespace microslip::solver
