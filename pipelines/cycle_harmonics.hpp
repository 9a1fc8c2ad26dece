/// @file
/// Harmonics above the first of the forces in a friction cycle, exact: every segment of the cycle is
/// A + B sin θ + C cos θ, and the integrals of that against sin hθ and cos hθ are closed forms.
///
///   f_sh = (1/π) Σ_segments ∫ f sin hθ dθ,   f_ch = (1/π) Σ_segments ∫ f cos hθ dθ,   h ≥ 2    (1)
///
/// Source: theory section 5, whose table of integrals ends at h = 1; products of sines and cosines are
/// turned into sums for the others.
#pragma once

#include <vector>

#include "contact/friction_cycle.hpp"

namespace microslip::pipelines {

/// Amplitudes of the harmonics 2, 3, …
struct HarmonicSeries {
  std::vector<double> sin;
  std::vector<double> cos;
};

struct CycleHarmonics {
  HarmonicSeries friction;  ///< [Pa], n_harmonics − 1 each
  HarmonicSeries normal;    ///< [Pa]
};

/// @param cycle        friction_cycle(point, motion).
/// @param n_harmonics  highest harmonic, ≥ 1; 1 gives empty series.
/// @note A point that sticks all the time in constant load has none: all are zero to rounding.
[[nodiscard]] CycleHarmonics higher_harmonics(const contact::FrictionCycle& cycle,
                                              const contact::PointParameters& point,
                                              const contact::PointMotion& motion, int n_harmonics);

}  // namespace microslip::pipelines
