/// @file
/// What a set of harmonics misses, told between two probes of harmonic_choice.hpp without their equations.
/// The response to force k alone, by the contact stiffness that the point has on its first harmonic,
///
///   d_k = ‖(Ω − k²ω² + i kω C + K)⁻¹ G^(k)‖ / a,       K = mean of the sine and cosine blocks of ∂G/∂q
///
/// follows the force, resonances at kω and the share that slips from point to point; what it leaves out, the
/// way from harmonic k back to the others, is taken over from the last probe, with r_k = d_k / d_k,probe:
///
///   e ≈ min( Σ_k r_k e_k,   max_θ |Σ_k e_k(θ)| + Σ_k |r_k − 1| e_k )
///
/// Costs the force alone at the motion's own events. Trusted where it leaves a margin that grows with every
/// point since the probe. Where it does not, it tells which harmonics the next probe need not look at.
#pragma once

#include <optional>
#include <vector>

#include "solver/harmonics/harmonic_choice.hpp"

namespace microslip::solver {

class HarmonicScreening {
 public:
  /// @param scene   borrowed.
  /// @param choice  borrowed.
  HarmonicScreening(const Scene& scene, const HarmonicChoice& choice)
      : scene_(scene), choice_(choice) {}

  /// Starts from a probe with the harmonics of skips() left out.
  void remember(const HarmonicBalance& balance, const NewtonResult& at,
                const HarmonicDecision& probe);
  /// Error by harmonics left out, relative to the amplitude; empty: ask for a probe.
  /// @param scale  of forces [N/√kg].
  [[nodiscard]] std::optional<double> missing(const HarmonicBalance& balance,
                                              const NewtonResult& at, double scale);
  /// What the probe that missing() asked for need not look at.
  [[nodiscard]] const HarmonicSkips& skips() const { return skips_; }

 private:
  struct Memory {
    HarmonicSet set;
    std::vector<HarmonicShare> shares;
    std::vector<double> direct;  // d_k of the shares
    double missing = 0.0;
    int highest = 0;  // probed
    int uses = 0;
    int n_partial = 0;  // probes since the last that looked at everything
  };

  /// @param ratios  r_k of the shares.
  void choose_skips(const std::vector<double>& ratios);

  const Scene& scene_;
  const HarmonicChoice& choice_;
  std::optional<Memory> memory_;
  HarmonicSkips skips_;
  std::vector<HarmonicShare> skipped_;  // of them, as they are now
};

}  // namespace microslip::solver
