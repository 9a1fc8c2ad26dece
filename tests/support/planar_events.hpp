/// @file
/// The planar friction cycle of one point of smooth surfaces by a third road, of full order: events
/// are located in extended precision, slip is integrated as an equation for the slider,
///
///   s' = λ e,   e = F/|F|,   F = K (x − s),   λ = (e·K x' − r') / (e·K e),   r = μ(|x'|) n     (1)
///
/// by extrapolation of the modified midpoint rule to order twelve, its Fourier integrals along with
/// it. At touch-down in slip (1) starts a little late, on the direction of the regular solution.
///
/// Source: theory section 9; E. Hairer, S. Nørsett, G. Wanner, Solving Ordinary Differential
/// Equations I, section II.9.
#pragma once

#include <vector>

#include "support/planar_reference.hpp"

namespace microslip::test {

/// μ(σ) = μ_k + (μ_s − μ_k) exp(−rate σ) with μ_s of the point and ω = 1.
struct EventCase {
  PlanarCase point;
  double kinetic = 0.0;
  double rate = 0.0;  ///< [s/m]; 0: μ = μ_s
};

struct EventReference {
  std::vector<long double> first;  ///< coefficients of f_p in the order of Harmonics, as the motion
  std::vector<long double> second;  ///< of f_r
  int n_slips = 0;                  ///< in the last period
  int n_periods = 0;                ///< until the slider was periodic
  bool settled = false;  ///< whether the slider ended where it began, to 1e-15 of its force
};

/// @param most_periods  that may pass until the slider is periodic.
[[nodiscard]] EventReference planar_events(const EventCase& c, int most_periods);

}  // namespace microslip::test
