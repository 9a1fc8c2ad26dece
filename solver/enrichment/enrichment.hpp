/// @file
/// What a richer model makes of a peak that a coarser one has solved, by one step (theory section 24). The
/// peak z = (q, ω) is embedded: what only the richer equations know is zero. Their residual R̃ there, not
/// zero, moves it:
///
///   [ R̃_q  R̃_ω ] [δq]   [ −R̃ ]      g = A_q · t,      [ R̃_q  R̃_ω ] t = [ 0 ]
///   [ g_q   g_ω ] [δω] = [ −g ]                        [    cᵀ     ]     [ 1 ]
///
///   g_z = ∂A_q/∂t − μᵀ ∂[R̃_q R̃_ω]/∂t,                [ R̃_q  R̃_ω; cᵀ ]ᵀ (μ, ν) = (A_q, 0)
///
/// A the amplitude of the output, c the tangent of the coarse branch. One adjoint solve for each goal splits
/// both by the rows of R̃, harmonic by harmonic:
///
///   δA = −Σ_k μ_k · R̃_k,        δω = −Σ_k η_k · R̃_k − g t_ω / (g_z · t)
///
/// exact to first order, A being stationary along the branch. Where contact changes much between the models the
/// second order is lost: the share of (area × period) in another state after the step tells.
#pragma once

#include <vector>

#include "solver/balance/harmonic_balance.hpp"
#include "solver/peak/local_peak.hpp"

namespace microslip::solver {

/// Effect of what the equations of one harmonic have that the embedded peak does not satisfy.
struct RicherShare {
  int order = 0;           ///< 0: the mean
  double amplitude = 0.0;  ///< δA / A, signed
  double frequency = 0.0;  ///< δω / ω, signed; 0 where `Enrichment::has_frequency` is false
  double force = 0.0;      ///< ‖R̃_k‖ over the scale of forces
};

struct Enrichment {
  double amplitude = 0.0;  ///< δA / A: sum of the shares
  double frequency = 0.0;  ///< δω / ω
  /// False: the place is an end of the range, the frequency was not asked for, or the peak is a kink without
  /// curvature.
  bool has_frequency = false;
  std::vector<RicherShare> shares;  ///< of all orders of the richer set, ascending, the mean first
  BranchVector point;               ///< where the step leads, on the plane across the coarse branch
  double length = 0.0;          ///< of the step, over the amplitude and the width of the resonance
  double states_changed = 0.0;  ///< share of (area × period); 0 where the force does not tell
  int evaluations = 0;
  /// The step is too long, or changes too much of the contact, for an estimate: solve the richer equations.
  [[nodiscard]] bool is_estimate() const;
};

/// c in scaled variables: the tangent of the branch; (0, 1) at an end of the range.
[[nodiscard]] BranchVector border_of(const LocalPeak& peak);

/// How the peak's frequency is to be treated.
enum class FrequencyStep { none, estimated };

/// The place of a coarser balance in the unknowns of a richer one of the same modes.
[[nodiscard]] LocalPeak embedded(const LocalPeak& peak, const HarmonicBalance& coarse,
                                 const HarmonicBalance& richer);

/// @param peak  in the unknowns of `richer`, solved in a coarser model; its tangent is that of the coarse
///              branch.
/// @param step  estimated: two more Jacobians, a little way along the branch either way.
[[nodiscard]] Enrichment enrich(const HarmonicBalance& richer, const LocalPeak& peak,
                                FrequencyStep step = FrequencyStep::estimated);

}  // namespace microslip::solver
