/// @file
/// What a richer model makes of the amplitude of a peak that a coarser one has solved, by one step
/// (theory section 24). The peak z = (q, ω) is embedded: what only the richer equations know is
/// zero. One adjoint solve splits the change of the amplitude A by the rows of their residual R̃
/// there, harmonic by harmonic:
///
///   [ R̃_q  R̃_ω; cᵀ ]ᵀ (μ, ν) = (A_q, 0),                δA = −Σ_k μ_k · R̃_k
///
/// c the tangent of the coarse branch. Exact to first order, A being stationary along the branch.
#pragma once

#include <vector>

#include "solver/balance/harmonic_balance.hpp"
#include "solver/peak/local_peak.hpp"

namespace microslip::solver {

/// Effect of what the equations of one harmonic have that the embedded peak does not satisfy.
struct RicherShare {
  int order = 0;           ///< 0: the mean
  double amplitude = 0.0;  ///< δA / A, signed
};

/// c in scaled variables: the tangent of the branch; (0, 1) at an end of the range.
[[nodiscard]] BranchVector border_of(const LocalPeak& peak);

/// The place of a coarser balance in the unknowns of a richer one of the same modes.
[[nodiscard]] LocalPeak embedded(const LocalPeak& peak, const HarmonicBalance& coarse,
                                 const HarmonicBalance& richer);

/// Of all orders of the richer set, ascending, the mean first; one evaluation of its equations.
/// Empty where they give nothing finite, or the peak has no amplitude.
/// @param peak  in the unknowns of `richer`, solved in a coarser model; its tangent is that of the
///              coarse branch.
[[nodiscard]] std::vector<RicherShare> richer_shares(HarmonicBalance& richer,
                                                     const LocalPeak& peak);

}  // namespace microslip::solver
