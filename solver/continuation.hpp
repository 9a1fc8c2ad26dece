/// @file
/// Pseudo-arclength continuation of the harmonic-balance equations over frequency (theory section
/// 16).
#pragma once

#include <vector>

#include "solver/continuation_options.hpp"
#include "solver/response_curve.hpp"
#include "solver/scene.hpp"

namespace microslip::solver {

/// The whole branch from frequency_begin to frequency_end with peaks and folds solved for as points
/// of their own. Never throws for a curve that cannot be completed:
/// `complete` and `diagnosis` say so.
/// @throws std::invalid_argument  options out of range.
[[nodiscard]] ResponseCurve trace_response(const Scene& scene, const ContinuationOptions& options,
                                           const PointObserver& observe = {});

/// The solution at one frequency, reached from the linear limits (single-frequency scenes). A
/// search adds the others it finds as branches of one point each.
[[nodiscard]] ResponseCurve solve_at_frequency(const Scene& scene, double frequency,
                                               const ContinuationOptions& options);

/// Solutions of the branch at one frequency, each solved for between the two curve points that
/// bracket it: several where the branch folds back. Branch order;
/// empty when the curve does not reach it.
[[nodiscard]] std::vector<ResponsePoint> points_at_frequency(const Scene& scene,
                                                             const ResponseCurve& curve,
                                                             double frequency,
                                                             const ContinuationOptions& options);

enum class LinearLimit { free, stuck };
/// Linear limit as a curve of its own: peaks solved for, points denser near resonances. Nothing is
/// searched. An undamped resonance that is excited ends it ("unbounded").
[[nodiscard]] ResponseCurve trace_linear(const Scene& scene, LinearLimit limit,
                                         const ContinuationOptions& options);

}  // namespace microslip::solver
