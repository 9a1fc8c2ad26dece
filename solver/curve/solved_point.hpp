/// @file
/// A solution at a fixed frequency as a point of a curve of its own, with its proof.
#pragma once

#include "solver/balance/harmonic_balance.hpp"
#include "solver/balance/newton.hpp"
#include "solver/continuation_options.hpp"
#include "solver/response_curve.hpp"

namespace microslip::solver {

/// @param options  whether it is told to be stable.
[[nodiscard]] ResponsePoint solved_point(HarmonicBalance& balance, const NewtonResult& solution,
                                         const ContinuationOptions& options);

}  // namespace microslip::solver
