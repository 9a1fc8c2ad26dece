/// @file
/// A solution at a fixed frequency as a point of a curve of its own, with its proof.
#pragma once

#include "solver/balance/harmonic_balance.hpp"
#include "solver/balance/newton.hpp"
#include "solver/response_curve.hpp"

namespace microslip::solver {

[[nodiscard]] ResponsePoint solved_point(HarmonicBalance& balance, const NewtonResult& solution);

}  // namespace microslip::solver
