/// @file
/// A structure with an isola known in closed form.
#pragma once

#include <cmath>
#include <memory>

#include "solver/scene.hpp"
#include "tests/support/full_force.hpp"

namespace microslip::tests {

/// Damping that depends on the amplitude, G = d(S) (−x_c, x_s) with S = x_s² + x_c² and
/// d = 0.1 + exp(−(S − 4)²): with F = 0.5 and ω₀ = 1
///   (1 − ω²)² = F²/S − d²
/// has solutions for small S, on the curve, and again between S = 5.5 and 25: an isola. Higher
/// harmonics stay zero.
class HumpedDamping final : public FullForce {
 public:
  HumpedDamping() : FullForce(1) {}
  [[nodiscard]] Eigen::MatrixXd stuck_stiffness() const override {
    return Eigen::MatrixXd::Zero(1, 1);
  }
  [[nodiscard]] contact::CycleReport report(const contact::Harmonics& /*q*/, double /*frequency*/,
                                            Workspace& /*work*/) const override {
    return {};
  }
  static double damping(double square) { return 0.1 + std::exp(-(square - 4.0) * (square - 4.0)); }
  [[nodiscard]] contact::ForceAndJacobian by_all(const contact::Harmonics& q,
                                                 double /*frequency*/) const override {
    const double s = q.rows()(1, 0);
    const double c = q.rows()(2, 0);
    const double square = s * s + c * c;
    const double d = damping(square);
    const double slope = -2.0 * (square - 4.0) * (d - 0.1);
    contact::ForceAndJacobian result;
    result.force = contact::Harmonics(q.n_harmonics(), 1);
    result.force.vector().segment(1, 2) << -d * c, d * s;
    const Eigen::Index size = q.rows().rows();
    result.jacobian = Eigen::MatrixXd::Zero(size, size);
    result.jacobian.block(1, 1, 2, 2) << -2.0 * s * c * slope, -d - 2.0 * c * c * slope,
        d + 2.0 * s * s * slope, 2.0 * s * c * slope;
    result.frequency_derivative = Eigen::VectorXd::Zero(size);
    return result;
  }
};

/// F sin θ on it. Around F = 0.5 the isola has its peak at F/0.1, the curve stays below 2.
inline solver::Scene isola_scene(double force) {
  solver::Scene scene;
  scene.natural_frequency = Eigen::VectorXd::Ones(1);
  scene.damping_ratio = Eigen::VectorXd::Zero(1);
  scene.output = Eigen::VectorXd::Ones(1);
  scene.excitation = contact::Harmonics(1, 1);
  scene.excitation.rows()(1, 0) = force;
  scene.contact = std::make_unique<HumpedDamping>();
  return scene;
}

}  // namespace microslip::tests
