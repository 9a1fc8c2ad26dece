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

#include <functional>
#include <optional>
#include <vector>

#include "solver/balance/harmonic_set.hpp"
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
/// @param set    harmonics of the other model, those of the point among them.
/// @param solve  Newton's method goes on across the branch where the step is long: then also empty
///               where it finds nothing.
[[nodiscard]] std::optional<PointShift> point_shift(const Scene& scene, const HarmonicSet& set,
                                                    const ResponsePoint& point, bool solve);

/// The same at the frequency of the point, [∂R/∂x] δ = −R: the change of its amplitude.
/// @param range  of the curve with the other forces: which harmonics are unknowns then.
/// @return relative, signed; empty: ∂R/∂x is singular, or the output does not move.
[[nodiscard]] std::optional<double> amplitude_shift(const Scene& scene,
                                                    const ContinuationOptions& range,
                                                    const ResponsePoint& point);

/// What harmonics that a curve lacks move it by, all along: away from its highest peak, which they
/// are chosen for or checked at, others may count. One step across the branch in the equations that
/// have them, solved where it is long, at the peaks and folds, at every eighth point (every
/// sixteenth of large scenes), and between two of these that differ; elsewhere linear from one to
/// the next.
/// @param scene    with a contact that takes `highest` harmonics.
/// @param curve    solved by harmonic balance.
/// @param highest  harmonic; of those beyond the curve's own the next few are taken.
/// @param stop     asked between points; true ends it.
/// @return sizes, one for each point; empty of a curve that is proved linear, and where nothing
///         could be told, or time was over.
[[nodiscard]] std::vector<PointShift> shifts_along(const Scene& scene, const ResponseCurve& curve,
                                                   int highest, const std::function<bool()>& stop);

}  // namespace microslip::solver
