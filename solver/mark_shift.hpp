/// @file
/// What other forces of the same contact move a solved peak or fold by, to first order: one
/// evaluation and one Newton step across the branch,
///
///   [∂R/∂x  ∂R/∂ω; tᵀ] δ = −(R, 0),   t the null vector of the rows above
///
/// A peak's amplitude and a fold's frequency are stationary along the branch, so that a step across
/// it tells their change. Source: theory section 24.
#pragma once

#include <optional>

#include "solver/response_curve.hpp"
#include "solver/scene.hpp"

namespace microslip::solver {

struct MarkShift {
  double frequency = 0.0;  ///< relative to that of the mark, signed
  double amplitude = 0.0;  ///< likewise
};

/// @param scene  with the other forces, in the same modes.
/// @param mark   solved without them; its harmonics are taken.
/// @return empty: the branch has no direction there, or the output does not move.
[[nodiscard]] std::optional<MarkShift> mark_shift(const Scene& scene, const ResponsePoint& mark);

}  // namespace microslip::solver
