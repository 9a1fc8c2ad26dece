/// @file
/// Modal scenes the solver is tested on: a chain of theory section 20, a patch, wild ones.
#pragma once

#include <cstdint>

#include "solver/scene.hpp"
#include "tests/support/random_scene.hpp"

namespace microslip::tests {

/// Theory section 20.3: two masses in a chain, the first rubs on the ground under a constant load.
[[nodiscard]] solver::Scene chain_scene(double preload);

struct PatchScene {
  int n_modes = 10;
  int n_points = 300;
};
/// A patch along one edge with smooth mode shapes, in the manner of the blade of paper A: first
/// resonances at 300 Hz and above, ζ = 0.002.
/// @param preload  total normal force [N]; negative: a gap.
[[nodiscard]] solver::Scene patch_scene(const PatchScene& size, double preload, double force = 1.0);

/// Wilder than random_scene(): 1–8 modes down to 1 % apart, 1–24 points, damping 1e-5 … 0.1,
/// contact stiffness 1e-3 … 1e3 of the structure's, preload 1e-2 … 1e3 of the force, gaps, static
/// loads, sweeps either way. The same on every machine:
/// no distribution of the standard library is used.
[[nodiscard]] RandomScene wild_scene(std::uint64_t seed);

/// A copy with forces, preloads and gaps multiplied by a factor.
[[nodiscard]] solver::Scene scaled_scene(const solver::Scene& scene, double factor);
/// A copy with the excitation turned by a phase [rad].
[[nodiscard]] solver::Scene turned_scene(const solver::Scene& scene, double phase);

/// Gives a scene of these builders the same contact for time integration.
/// @throws std::bad_cast  the contact is not a ReadablePatch.
void add_transient(solver::Scene& scene);
/// Replaces the contact of a scene of these builders by the same points cycled event by event: any
/// number of harmonics.
/// @throws std::bad_cast  the contact is not a ReadablePatch.
void use_event_cycles(solver::Scene& scene);
/// Replaces it by the same points sampled in lanes.
/// @throws std::bad_cast  the contact is not a ReadablePatch.
void use_lanes(solver::Scene& scene, int instants);

}  // namespace microslip::tests
