/// @file
/// A cubic spring behind the door of ModalForce: one mode, one harmonic,
/// everything known in closed form.
///
///   q̈ + 2ζq̇ + q + α q³ = F sin θ; with A = hypot(q_s, q_c) and one harmonic, without a mean,
///   F² = [(1 − ω² + ¾αA²) A]² + (2ζωA)²
#pragma once

#include <cmath>
#include <memory>

#include "solver/scene.hpp"
#include "tests/support/full_force.hpp"

namespace microslip::tests {

class CubicSpring final : public FullForce {
 public:
  explicit CubicSpring(double alpha) : FullForce(1), alpha_(alpha) {}
  [[nodiscard]] Eigen::MatrixXd stuck_stiffness() const override {
    return Eigen::MatrixXd::Zero(1, 1);
  }
  [[nodiscard]] contact::CycleReport report(const contact::Harmonics& /*q*/, double /*frequency*/,
                                            Workspace& /*work*/) const override {
    return {};
  }
  /// α (q³) on mean and first harmonic: b³ + 3/2 b A² and (3b² + ¾A²)(q_s, q_c).
  [[nodiscard]] contact::ForceAndJacobian by_all(const contact::Harmonics& q,
                                                 double /*frequency*/) const override {
    const double b = q.rows()(0, 0);
    const double s = q.rows()(1, 0);
    const double c = q.rows()(2, 0);
    const double square = s * s + c * c;
    contact::ForceAndJacobian result;
    result.force = contact::Harmonics(1, 1);
    result.force.vector() << b * b * b + 1.5 * b * square, (3 * b * b + 0.75 * square) * s,
        (3 * b * b + 0.75 * square) * c;
    result.force.vector() *= alpha_;
    result.jacobian.resize(3, 3);
    result.jacobian << 3 * b * b + 1.5 * square, 3 * b * s, 3 * b * c,    //
        6 * b * s, 3 * b * b + 0.75 * square + 1.5 * s * s, 1.5 * s * c,  //
        6 * b * c, 1.5 * s * c, 3 * b * b + 0.75 * square + 1.5 * c * c;
    result.jacobian *= alpha_;
    result.frequency_derivative = Eigen::VectorXd::Zero(3);
    return result;
  }

 private:
  double alpha_;
};

struct Duffing {
  double alpha = 0.1;
  double zeta = 0.02;
  double force = 0.2;

  [[nodiscard]] solver::Scene scene() const {
    solver::Scene s;
    s.natural_frequency = Eigen::VectorXd::Ones(1);
    s.damping_ratio = Eigen::VectorXd::Constant(1, zeta);
    s.output = Eigen::VectorXd::Ones(1);
    s.excitation = contact::Harmonics(1, 1);
    s.excitation.rows()(1, 0) = force;
    s.contact = std::make_unique<CubicSpring>(alpha);
    return s;
  }
  /// (F(A, ω)² − F²) / F²: zero on the response curve.
  [[nodiscard]] double defect(double amplitude, double omega) const {
    const double elastic = (1.0 - omega * omega + 0.75 * alpha * amplitude * amplitude) * amplitude;
    const double viscous = 2.0 * zeta * omega * amplitude;
    return (elastic * elastic + viscous * viscous) / (force * force) - 1.0;
  }
  /// d(F²)/dA at fixed ω: zero at a fold.
  [[nodiscard]] double slope(double amplitude, double omega) const {
    const double a = 1.0 - omega * omega;
    const double b = 0.75 * alpha;
    const double square = amplitude * amplitude;
    return 2.0 * amplitude *
           ((a + b * square) * (a + 3.0 * b * square) + 4.0 * zeta * zeta * omega * omega);
  }
};

}  // namespace microslip::tests
