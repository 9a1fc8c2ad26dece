/// @file
/// Harmonics that matter at a solution, chosen there. What leaving harmonic k out does is told by one
/// Newton step of the equations that have it, on the plane across the branch, so that a fold does not
/// count as an error:
///
///   added   [∂R/∂x  ∂R/∂ω; tᵀ] δ_k = [−G^(k); 0],     G^(k) the contact force at the motion without k
///   dropped the same matrix, with the force on rows k that takes x^(k) to zero
///
///   e(θ) = Σ_k output · δ_k(θ) / a           a the amplitude of the output, means aside
///
/// The contact stiffness and the coupling of harmonics are in the matrix: without contact it is
/// Z(kω)⁻¹ G^(k). max_θ |e| bounds the change of the amplitude, half the difference of the output's extrema.
/// Harmonics are added, the largest first, until those left out make no more than half the tolerance (a margin
/// for second order and for harmonics beyond those probed), and dropped while all that is left out makes no
/// more than a third: the gap between the two keeps a set from chattering.
#pragma once

#include <optional>
#include <vector>

#include "solver/balance/harmonic_balance.hpp"
#include "solver/balance/newton.hpp"

namespace microslip::solver {

/// What one harmonic does to the output.
struct HarmonicShare {
  int order = 0;
  double error = 0.0;    ///< Σ_h |output · δ_k^(h)| / a
  Eigen::VectorXd wave;  ///< harmonics of output · δ_k / a: mean, which is zero, sine, cosine, …
};

/// A set of harmonics with what it leaves out.
struct HarmonicDecision {
  HarmonicSet set;
  std::vector<int> added;  ///< those that matter most first
  double left_out = 0.0;   ///< max_θ |e| by harmonics that the set misses, of those probed
  double missing = 0.0;    ///< the same of the set that was asked about
  std::vector<HarmonicShare> shares;  ///< of those probed
  Harmonics force;                    ///< of the contact, up to the highest probed
};

/// Harmonics known to do next to nothing, which a probe need not look at.
struct HarmonicSkips {
  std::vector<int> orders;
  double error = 0.0;  ///< bound on what they do together
};

class HarmonicChoice {
 public:
  /// @param scene      borrowed.
  /// @param tolerance  of the amplitude, relative, > 0.
  /// @param highest    harmonic that may be added, ≥ 1.
  /// @throws std::invalid_argument  tolerance or highest out of range.
  HarmonicChoice(const Scene& scene, double tolerance, int highest);

  /// Error that needs no more harmonics [-]: half the tolerance.
  [[nodiscard]] double allowed() const;
  /// Highest order that is looked at.
  [[nodiscard]] int probed(const HarmonicSet& set, double frequency) const;
  /// Orders that a set leaves out in which a force is more than rounding.
  /// @param scale  of forces [N/√kg].
  [[nodiscard]] static std::vector<int> heard(const HarmonicSet& set, const Harmonics& force,
                                              double scale);
  /// What every point has: the first harmonic and those of the excitation.
  [[nodiscard]] const HarmonicSet& least() const { return least_; }
  /// The set of a balance with what its solution misses.
  /// @param tangent  of the branch in variables of `scaling`; (0, 1): at a fixed frequency.
  /// @param skips    left out of the probe, their error is added to what is missing.
  [[nodiscard]] HarmonicDecision enlarged(const HarmonicBalance& balance, const BranchVector& point,
                                          const BranchVector& tangent, const Scaling& scaling,
                                          const HarmonicSkips& skips = {}) const;
  /// The set without what its solution does not need; `left_out` is what goes.
  /// @param missing  of the set now, as enlarged() tells.
  [[nodiscard]] HarmonicDecision reduced(const HarmonicBalance& balance, const NewtonResult& solution,
                                         const BranchVector& tangent, const Scaling& scaling,
                                         double missing) const;

 private:
  const Scene& scene_;
  double tolerance_;
  int highest_;
  HarmonicSet least_;
  double top_frequency_;  // highest resonance of the linear limits [rad/s]
};

/// A solution at a fixed frequency with the harmonics it needs.
struct SettledSolution {
  HarmonicSet set;
  NewtonResult solution;
  double left_out = 0.0;
  bool settled = true;  ///< false: the equations with more harmonics were not solved
  long iterations = 0;
  long evaluations = 0;
};

/// Adds harmonics until nothing is missing, solving in between.
/// @param at  converged, in the unknowns of `set`.
[[nodiscard]] SettledSolution settle_harmonics(const HarmonicChoice& choice, const Scene& scene,
                                               HarmonicSet set, NewtonResult at, double tolerance);

}  // namespace microslip::solver
