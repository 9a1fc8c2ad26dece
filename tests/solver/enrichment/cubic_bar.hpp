/// @file
/// A cubic spring between a point of a structure of any number of modes and the ground, in any
/// number of harmonics: α u³ with u = φ · q. Products of trigonometric polynomials are sampled
/// often enough to be exact.
#pragma once

#include <cmath>
#include <numbers>
#include <utility>

#include "solver/scene.hpp"
#include "tests/support/full_force.hpp"

namespace microslip::tests {

class CubicBar final : public FullForce {
 public:
  CubicBar(double alpha, Eigen::VectorXd shape)
      : FullForce(shape.size()), alpha_(alpha), shape_(std::move(shape)) {}
  [[nodiscard]] Eigen::MatrixXd stuck_stiffness() const override {
    return Eigen::MatrixXd::Zero(n_modes(), n_modes());
  }
  [[nodiscard]] contact::CycleReport report(const contact::Harmonics& /*q*/, double /*frequency*/,
                                            Workspace& /*work*/) const override {
    return {};
  }
  [[nodiscard]] contact::ForceAndJacobian by_all(const contact::Harmonics& q,
                                                 double /*frequency*/) const override {
    const Eigen::Index rows = q.rows().rows();
    const Eigen::VectorXd u = q.rows() * shape_;
    const Eigen::Index n = 4 * rows;  // a product of three has 3H, with a weight 4H < n/2
    Eigen::VectorXd force = Eigen::VectorXd::Zero(rows);
    Eigen::MatrixXd slope = Eigen::MatrixXd::Zero(rows, rows);
    for (Eigen::Index i = 0; i < n; ++i) {
      const double phase = 2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n);
      Eigen::VectorXd basis = Eigen::VectorXd::Ones(rows);
      for (Eigen::Index k = 1; 2 * k < rows; ++k) {
        basis[2 * k - 1] = std::sin(static_cast<double>(k) * phase);
        basis[2 * k] = std::cos(static_cast<double>(k) * phase);
      }
      Eigen::VectorXd weights = 2.0 / static_cast<double>(n) * basis;
      weights[0] *= 0.5;
      const double value = basis.dot(u);
      force += alpha_ * value * value * value * weights;
      slope += 3.0 * alpha_ * value * value * weights * basis.transpose();
    }
    contact::ForceAndJacobian result;
    result.force = contact::Harmonics(q.n_harmonics(), n_modes());
    result.force.rows() = force * shape_.transpose();
    const Eigen::Index m = n_modes();
    result.jacobian.resize(rows * m, rows * m);
    for (Eigen::Index i = 0; i < rows; ++i) {
      for (Eigen::Index j = 0; j < rows; ++j) {
        result.jacobian.block(i * m, j * m, m, m) = slope(i, j) * shape_ * shape_.transpose();
      }
    }
    result.frequency_derivative = Eigen::VectorXd::Zero(rows * m);
    return result;
  }

 private:
  double alpha_;
  Eigen::VectorXd shape_;
};

}  // namespace microslip::tests
