/// @file
/// The friction cycle of one point under periodic motion with any number of harmonics, by another
/// road than the event law: the slider is marched from rest for two periods in extended precision;
/// the first breach of a guard is found by halving every interval on which a bound of its curvature
/// does not rule a breach out. Knows only the laws n = max(0, n₀ + k_v v), |f| ≤ μ n,
/// f = k_u (u − s).
#pragma once

#include <string>
#include <vector>

#include "contact/harmonics.hpp"
#include "contact/patch/contact_patch.hpp"

namespace microslip::test {

struct MotionReference {
  std::vector<long double> friction;  ///< mean, sin θ, cos θ, sin 2θ, …
  std::vector<long double> normal;
  long double dissipated_energy = 0.0L;  ///< ∫ μ n |ds|
  long double slip_distance = 0.0L;
  std::string sequence;  ///< states over one period from θ = 0, e.g. "SPSE"
};

/// @param motion        columns u, v.
/// @param n_harmonics   of the forces.
/// @throws std::runtime_error  the march does not end (a fault of the reference).
[[nodiscard]] MotionReference motion_reference(const contact::PointParameters& point,
                                               const contact::Harmonics& motion, int n_harmonics);

}  // namespace microslip::test
