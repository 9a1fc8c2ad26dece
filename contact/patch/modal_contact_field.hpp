/// @file
/// Continuous mode shapes on a patch: weighted least-squares fit in a polynomial basis over (p, r),
/// orthonormal over the samples, degree by cross-validation, fit error per mode (paper A, section
/// 4.2).
///
///   minimise Σ_i w_i (y_i − Σ_k c_k V_k(p_i, r_i))²,     √w V = Q R,   c = R⁻¹ Qᵀ √w y
///
/// What one sample would be off if it had been left out follows from the fit itself, with the
/// diagonal of the hat matrix H = Q Qᵀ:  e_i / (1 − H_ii). The degree is the smallest whose
/// leave-one-out error, over all modes and components together, is within 5 % of the least. Terms
/// the samples cannot tell apart (all on a line, too few) are left out.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "contact/numerics/polynomial_basis.hpp"
#include "contact/patch.hpp"

namespace microslip::contact {

class ModalContactField {
 public:
  static constexpr int max_degree = 12;

  /// @param p, r     coordinates of the samples in the patch plane [m], n ≥ 1 each.
  /// @param weights  area weights of the samples [m²], n, ≥ 0 and not all 0.
  /// @param shapes   values there, n × n_modes each; w may be empty.
  /// @param degree   total degree of the basis, 0 … max_degree; without a value it is chosen by
  ///                 leave-one-out cross-validation. A degree the samples cannot carry is lowered
  ///                 (see degree()).
  /// @param between  places (p, r) all over the patch, k × 2: terms that the samples hold down and
  ///                 that grow there are left out. Without rows nothing is known between the
  ///                 samples.
  /// @throws std::invalid_argument  sizes differ, a value is not finite or out of its range.
  ModalContactField(const Eigen::VectorXd& p, const Eigen::VectorXd& r,
                    const Eigen::VectorXd& weights, const ModalShapes& shapes,
                    std::optional<int> degree, const Eigen::MatrixX2d& between = {});

  /// @param p, r  any points of the patch plane [m], n each.   @return n × n_modes each.
  [[nodiscard]] ModalShapes at(const Eigen::VectorXd& p, const Eigen::VectorXd& r) const;
  /// Degree in use, never more than was asked for.
  [[nodiscard]] int degree() const { return degree_; }
  /// Leave-one-out error of each mode relative to its own rms size over u, v and w [-], n_modes.
  /// A mode that does not move the patch has error 0; samples that cannot be left out (as many
  /// terms as samples) count with their residual.
  [[nodiscard]] const Eigen::VectorXd& fit_error() const { return fit_error_; }

 private:
  int degree_ = 0;
  bool has_w_ = false;
  Eigen::VectorXd fit_error_;
  PolynomialBasis basis_;
  Eigen::MatrixXd coefficients_;  // n_terms(degree) × (2 or 3) n_modes: u, v, w side by side
};

}  // namespace microslip::contact
