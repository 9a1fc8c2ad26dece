/// @file
/// Modal scenes the solver is tested on: closed forms, a chain of theory section 20, a patch, wild ones.
#pragma once

#include <cstdint>
#include <utility>

#include <Eigen/Core>

#include "contact/modal_force.hpp"
#include "solver/scene.hpp"
#include "tests/support/random_scene.hpp"

namespace microslip::tests {

/// Duffing's spring γ q³ on one mode, in the first harmonic and the mean:
///   G_s = γ (3/4 a² + 3 b²) A_s,  G_c likewise,  G_b = γ (b³ + 3/2 a² b),   a² = A_s² + A_c², b = B.
/// Its stuck limit is that of a linear spring of the given stiffness: there is none.
class CubicSpring final : public contact::ModalForce {
 public:
  explicit CubicSpring(double gamma) : gamma_(gamma) {}
  [[nodiscard]] Eigen::Index n_modes() const override { return 1; }
  [[nodiscard]] contact::ForceAndJacobian evaluate(const contact::Harmonics& q,
                                                   double frequency) const override;
  [[nodiscard]] contact::CycleReport report(const contact::Harmonics& q,
                                            double frequency) const override;
  [[nodiscard]] Eigen::MatrixXd stuck_stiffness() const override;

 private:
  double gamma_;
};

/// q̈ + 2ζω₀q̇ + ω₀²q + γq³ = F sin θ, output q.
struct Duffing {
  double frequency = 1.0;
  double damping_ratio = 0.02;
  double force = 0.1;
  double gamma = 0.05;

  [[nodiscard]] solver::Scene scene() const;
  /// ω of the solutions with amplitude a: (ω₀² + ¾γa² − ω²)² + (2ζω₀ω)² = (F/a)²; the roots ω², in
  /// descending order; NaN where there are none.
  [[nodiscard]] std::pair<double, double> frequencies(double amplitude) const;
};

/// Theory section 20.3: two masses in a chain, the first rubs on the ground under a constant load.
[[nodiscard]] solver::Scene chain_scene(double preload);

struct PatchScene {
  int n_modes = 10;
  int n_points = 300;
};
/// A patch along one edge with smooth mode shapes, in the manner of the blade of paper A: first
/// resonances at 300 Hz and above, ζ = 0.002. @param preload  total normal force [N]; negative: a gap.
[[nodiscard]] solver::Scene patch_scene(const PatchScene& size, double preload, double force = 1.0);

/// Wilder than random_scene(): 1–8 modes down to 1 % apart, 1–24 points, damping 1e-5 … 0.1, contact
/// stiffness 1e-3 … 1e3 of the structure's, preload 1e-2 … 1e3 of the force, gaps, static loads, sweeps
/// either way. The same on every machine: no distribution of the standard library is used.
[[nodiscard]] RandomScene wild_scene(std::uint64_t seed);

/// A copy with forces, preloads and gaps multiplied by a factor.
[[nodiscard]] solver::Scene scaled_scene(const solver::Scene& scene, double factor);
/// A copy with the excitation turned by a phase [rad].
[[nodiscard]] solver::Scene turned_scene(const solver::Scene& scene, double phase);

}  // namespace microslip::tests
