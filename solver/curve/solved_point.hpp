/// @file
/// A solution at a fixed frequency as a point of a curve of its own, with its proof.
#pragma once

#include <string>

#include "solver/balance/harmonic_balance.hpp"
#include "solver/balance/newton.hpp"
#include "solver/continuation_options.hpp"
#include "solver/response_curve.hpp"

namespace microslip::solver {

/// @param options  whether it is told to be stable, and what its proof must meet.
/// @return  solved closer where the proof would fail. What keeps it from being a row is told by
///          `why`; empty: nothing.
struct SolvedPoint {
  ResponsePoint point;
  std::string why;
  int evaluations = 0;  ///< spent on that
};
[[nodiscard]] SolvedPoint solved_point(HarmonicBalance& balance, const NewtonResult& solution,
                                       const ContinuationOptions& options);

}  // namespace microslip::solver
