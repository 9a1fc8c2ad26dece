/// @file
/// Random modal scenes for campaigns: few modes, few contact points, parameters log-uniform around
/// values that make the contact matter.
#pragma once

#include <cstdint>

#include "solver/continuation.hpp"
#include "solver/scene.hpp"
#include "tests/support/readable_patch.hpp"

namespace microslip::tests {

struct RandomScene {
  solver::Scene scene;
  solver::ContinuationOptions options;
};

/// The scene of a seed; the same on every machine with the same standard library.
[[nodiscard]] RandomScene random_scene(std::uint64_t seed);

/// One mode against the ground through one point: m = 1 kg, φ_u, φ_v given.
struct SinglePoint {
  double frequency = 1.0;  ///< ω_n [rad/s]
  double damping_ratio = 0.01;
  double force = 1.0;  ///< of sin θ [N/√kg]
  double phi_u = 1.0;
  double phi_v = 0.0;
  contact::PointParameters point;
};
[[nodiscard]] solver::Scene single_point_scene(const SinglePoint& single);

/// Paper B figure 9 (theory section 20.4): three degrees of freedom,
/// jumps at preloads of 25 to 50 N.
[[nodiscard]] solver::Scene three_dof_scene(double preload, double force_factor = 1.0);

}  // namespace microslip::tests
