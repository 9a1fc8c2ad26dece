/// @file
/// Pseudo-arclength continuation of the harmonic-balance equations over frequency (theory section 16).
#pragma once

#include <functional>
#include <vector>

#include "solver/harmonic_set.hpp"
#include "solver/response_curve.hpp"
#include "solver/scene.hpp"

namespace microslip::solver {

struct ContinuationOptions {
  double frequency_begin = 0.0;  ///< [rad/s], > 0
  double frequency_end = 0.0;    ///< [rad/s], > 0; may be below frequency_begin
  int n_harmonics = 1;           ///< highest harmonic of the unknowns, ≥ 1
  std::vector<int> orders;       ///< the only harmonics of the unknowns; empty: 1 … n_harmonics
  /// Above 0: one set is chosen for the curve, so that those left out change its highest peaks by less than
  /// this share of the amplitude (enrichment/curve_harmonics.hpp); n_harmonics is the highest that may be
  /// added, `orders` is not used.
  double harmonic_tolerance = 0.0;
  /// Relative, see ResponsePoint::residual; > 0. Of every point; rounding of the residual bounds it below.
  double residual_tolerance = 1e-11;
  int max_points = 20000;
  /// Looks for a proof that the curve is linear (linear_certificate.hpp) before it is walked.
  bool linear_certificate = true;
  /// Starts per frequency of a search for detached branches (branch_search.hpp); 0: none.
  int search_starts = 0;
};

/// What a curve, or the choice of its harmonics, begins with.
[[nodiscard]] HarmonicSet first_harmonics(const Scene& scene, const ContinuationOptions& options);

/// Called after each accepted point; false stops the curve (diagnosis "interrupted").
using PointObserver = std::function<bool(const ResponsePoint&)>;

/// The whole branch from frequency_begin to frequency_end with peaks and folds solved for as points of
/// their own. Never throws for a curve that cannot be completed: `complete` and `diagnosis` say so.
/// @throws std::invalid_argument  options out of range.
[[nodiscard]] ResponseCurve trace_response(const Scene& scene, const ContinuationOptions& options,
                                           const PointObserver& observe = {});

/// The solution at one frequency, reached from the linear limits (single-frequency scenes). A search adds the
/// others it finds as branches of one point each.
[[nodiscard]] ResponseCurve solve_at_frequency(const Scene& scene, double frequency,
                                               const ContinuationOptions& options);

/// Solutions of the branch at one frequency, each solved for between the two curve points that bracket
/// it: several where the branch folds back. Branch order; empty when the curve does not reach it.
[[nodiscard]] std::vector<ResponsePoint> points_at_frequency(const Scene& scene,
                                                             const ResponseCurve& curve,
                                                             double frequency,
                                                             const ContinuationOptions& options);

enum class LinearLimit { free, stuck };
/// Linear limit as a curve of its own: peaks solved for, points denser near resonances. Nothing is searched.
/// An undamped resonance that is excited ends it ("unbounded").
[[nodiscard]] ResponseCurve trace_linear(const Scene& scene, LinearLimit limit,
                                         const ContinuationOptions& options);

}  // namespace microslip::solver
