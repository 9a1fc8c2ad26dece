/// @file
/// What the harmonics that a curve was given leave out, at its highest peak: the peak is solved again with more
/// (theory section 24; where the step is long the richer equations are solved, and here they always are).
#pragma once

#include <optional>

#include "solver/continuation.hpp"

namespace microslip::solver {

struct RicherPeak {
  double frequency = 0.0;  ///< with more harmonics [rad/s]
  double amplitude = 0.0;  ///< [m]
  /// (amplitude − that of the curve) / amplitude; empty: the peak is not found from that of the curve, which is far
  /// from it then, or on another branch.
  std::optional<double> change;
  int highest = 0;  ///< harmonic
};

/// @param scene    the same with a contact that takes `highest` harmonics.
/// @param range    of the curve, harmonics given.
/// @param curve    its highest peak, or end of the range, is taken.
/// @param highest  harmonic, ≥ 5 more than those of the curve.
/// @return empty: the curve has no peak, and no end of the range, to begin with.
[[nodiscard]] std::optional<RicherPeak> richer_peak(const Scene& scene,
                                                    const ContinuationOptions& range,
                                                    const ResponseCurve& curve, int highest);

}  // namespace microslip::solver
