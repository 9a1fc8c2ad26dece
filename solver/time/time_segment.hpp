/// @file
/// Motion within one time step: the polynomial of degree five that has q, q̇ and q̈ of both ends,
///
///   q(x) = q₀ + h q̇₀ x + ½ h² q̈₀ x² + A x³ + B x⁴ + C x⁵,      x = (t − t₀)/h in [0, 1]
///
/// Error O(h⁶) in q, O(h⁵) in q̇, O(h⁴) in q̈. It is built from increments over the step, so that
/// velocities keep their accuracy in steps of any shortness.
///
/// Internal variables of the held states are carried along as polynomials of degree four in the
/// form of Hairer, Nørsett & Wanner, Solving Ordinary Differential Equations I, section II.6:
/// error O(h⁵).
#pragma once

#include <utility>

#include <Eigen/Core>

#include "contact/transient_force.hpp"

namespace microslip::solver {

/// p(x) = c₀ + x [c₁ + (1 − x)(c₂ + x [c₃ + (1 − x) c₄])], one row per internal variable.
using InternalPolynomials = Eigen::Matrix<double, Eigen::Dynamic, 5>;

class TimeSegment {
 public:
  /// @param motion                       at the begin.
  /// @param displacement_step, velocity_step  what the step adds to q and q̇.
  /// @param acceleration, acceleration_end    q̈ at both ends, under the force held in the step.
  /// @param internal                     of the internal variables, if there are any.
  TimeSegment(double begin, double length, const contact::ModalMotion& motion,
              const Eigen::VectorXd& displacement_step, const Eigen::VectorXd& velocity_step,
              const Eigen::VectorXd& acceleration, const Eigen::VectorXd& acceleration_end,
              InternalPolynomials internal = {})
      : begin_(begin),
        length_(length),
        coefficients_(motion.q.size(), 6),
        internal_(std::move(internal)) {
    const Eigen::VectorXd slope = length * motion.velocity;
    const Eigen::VectorXd curve = length * length * acceleration;
    const Eigen::VectorXd r0 = displacement_step - slope - 0.5 * curve;
    const Eigen::VectorXd r1 = length * velocity_step - curve;
    const Eigen::VectorXd r2 = length * length * acceleration_end - curve;
    coefficients_ << motion.q, slope, 0.5 * curve, 10.0 * r0 - 4.0 * r1 + 0.5 * r2,
        -15.0 * r0 + 7.0 * r1 - r2, 6.0 * r0 - 3.0 * r1 + 0.5 * r2;
  }

  [[nodiscard]] double begin() const { return begin_; }
  [[nodiscard]] double length() const { return length_; }
  /// Powers of x, n_modes × 6.
  [[nodiscard]] const Eigen::Matrix<double, Eigen::Dynamic, 6>& coefficients() const {
    return coefficients_;
  }
  [[nodiscard]] contact::ModalMotion at(double x) const {
    using Powers = Eigen::Matrix<double, 6, 1>;
    const double x2 = x * x;
    const Powers value{1.0, x, x2, x2 * x, x2 * x2, x2 * x2 * x};
    const Powers slope{0.0, 1.0, 2.0 * x, 3.0 * x2, 4.0 * x2 * x, 5.0 * x2 * x2};
    const Powers curve{0.0, 0.0, 2.0, 6.0 * x, 12.0 * x2, 20.0 * x2 * x};
    return {coefficients_.lazyProduct(value), coefficients_.lazyProduct(slope) / length_,
            coefficients_.lazyProduct(curve) / (length_ * length_)};
  }
  [[nodiscard]] bool has_internal() const { return internal_.rows() > 0; }
  [[nodiscard]] Eigen::VectorXd internal_at(double x) const {
    const double y = 1.0 - x;
    return internal_ * Eigen::Matrix<double, 5, 1>{1.0, x, x * y, x * x * y, x * x * y * y};
  }

 private:
  double begin_;
  double length_;
  Eigen::Matrix<double, Eigen::Dynamic, 6> coefficients_;
  InternalPolynomials internal_;
};

}  // namespace microslip::solver
