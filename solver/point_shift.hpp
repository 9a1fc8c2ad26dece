/// @file
/// What other forces, in the same modes, move a solved point of a curve by, to first order: one
/// evaluation and one Newton step across the branch,
///
///   [∂R/∂x  ∂R/∂ω; tᵀ] δ = −(R, 0),   t the null vector of the rows above
///
/// A peak's amplitude and a fold's frequency are stationary along the branch, so that a step across
/// it tells their change; where the branch is steep, it tells how far the curve moves and not what
/// amplitudes at one frequency do. Source: theory section 24.
#pragma once

#include <optional>

#include "solver/continuation_options.hpp"
#include "solver/response_curve.hpp"
#include "solver/scene.hpp"

namespace microslip::solver {

struct PointShift {
  double frequency = 0.0;  ///< relative to that of the point, signed
  double amplitude = 0.0;  ///< likewise
};

/// @param scene  with the other forces, in the same modes.
/// @param point  solved without them; its harmonics are taken.
/// @return empty: the branch has no direction there, or the output does not move.
[[nodiscard]] std::optional<PointShift> point_shift(const Scene& scene, const ResponsePoint& point);

/// The same at the frequency of the point, [∂R/∂x] δ = −R: the change of its amplitude.
/// @param range  of the curve with the other forces: which harmonics are unknowns then.
/// @return relative, signed; empty: ∂R/∂x is singular, or the output does not move.
[[nodiscard]] std::optional<double> amplitude_shift(const Scene& scene,
                                                    const ContinuationOptions& range,
                                                    const ResponsePoint& point);

}  // namespace microslip::solver
