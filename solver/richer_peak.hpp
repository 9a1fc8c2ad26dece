/// @file
/// What the harmonics that a curve was given leave out, at its highest peak: the peak is solved
/// again with more (theory section 24; where the step is long the richer equations are solved,
/// and here they always are).
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "solver/continuation_options.hpp"
#include "solver/response_curve.hpp"
#include "solver/scene.hpp"

namespace microslip::solver {

/// A peak that is so many times as high as that of another model, or less, is that of another
/// resonance.
inline constexpr double another_peak = 0.2;

struct RicherPeak {
  double frequency = 0.0;  ///< with more harmonics [rad/s]
  double amplitude = 0.0;  ///< [m]
  /// (amplitude − that of the curve) / amplitude; empty: the peak is not found from that of the
  /// curve, which is far from it then, or on another branch.
  std::optional<double> change;
  int highest = 0;                 ///< harmonic
  double seconds = 0.0;            ///< that solving it took
  double dissipated_energy = 0.0;  ///< by friction in a period, with more harmonics [J]
  std::vector<int> beyond{};       ///< harmonics above `highest` that resonate at the peak as well
  double left_out = 0.0;           ///< |δA| / A of the next ones, by one step; 0: not asked
};

/// @param scene    the same with a contact that takes `highest` harmonics, and `next`.
/// @param range    of the curve, harmonics given. Up to its `highest_resonance` harmonics beyond
///                 `highest` are solved for as well where they meet a mode at the peak.
/// @param curve    its highest peak, or end of the range, is taken.
/// @param highest  harmonic, ≥ 5 more than those of the curve.
/// @param next     those up to it are told by one step, and solved for as well where that moves the
///                 peak by more than 1 %: then it is the highest of the result.
/// @return empty: the curve has no peak, and no end of the range, to begin with.
[[nodiscard]] std::optional<RicherPeak> richer_peak(const Scene& scene,
                                                    const ContinuationOptions& range,
                                                    const ResponseCurve& curve, int highest,
                                                    int next = 0);

/// Harmonics beyond those of a curve that may resonate with a mode somewhere along it, up to the
/// highest: with them it may have another peak there, higher than its own.
/// @param share  of the curve's largest motion and amplitude: what moves less is not named.
[[nodiscard]] std::vector<int> resonant_harmonics(const Scene& scene,
                                                  const ContinuationOptions& range,
                                                  const ResponseCurve& curve, int highest,
                                                  double share);

/// The options with the harmonics that points of the curve have: they may have been chosen.
[[nodiscard]] ContinuationOptions with_harmonics_of(const Scene& scene,
                                                    const ContinuationOptions& range,
                                                    const ResponseCurve& curve);

/// The same blade modelled otherwise: finer cells, other shapes, another mesh, friction along r.
struct OtherModel {
  const Scene& scene;
  /// Its modal coordinates from those of the model at hand, N' × N; empty: the same modes.
  Eigen::MatrixXd embedding{};
  double frequency_factor = 1.0;  ///< of its resonance, about, over that of the model at hand
  /// Relative change of the amplitude that one step may tell, where it solves most of the equations
  /// of the other model (theory section 24); 0: they are solved in any case.
  double told_by_step = 0.0;
};

/// A peak of two models.
struct PeakOfBoth {
  double frequency = 0.0, amplitude = 0.0;                        ///< of the curve [rad/s], [m]
  double other_frequency = 0.0, other_amplitude = 0.0;            ///< in the other model
  double dissipated_energy = 0.0, other_dissipated_energy = 0.0;  ///< by friction in a period [J]
  bool is_solved = true;  ///< in the other model; false: one step tells it
};

/// The highest peak of a curve, or end of its range, solved for again in another model with the
/// same harmonics. Where what is found is much lower, or nothing is, points beside the peak are
/// tried too, and the highest counts.
/// @param scene, range  of the curve.
/// @return empty: the curve has no such point, or the other model has no peak near by.
[[nodiscard]] std::optional<PeakOfBoth> peak_elsewhere(const Scene& scene,
                                                       const ContinuationOptions& range,
                                                       const ResponseCurve& curve,
                                                       const OtherModel& other);

}  // namespace microslip::solver
