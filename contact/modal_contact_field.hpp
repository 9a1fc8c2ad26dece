/// @file
/// Continuous mode shapes on a patch: least-squares fit in an orthogonal polynomial basis over (p, r),
/// degree by cross-validation, fit error per mode (paper A, section 4.2).
#pragma once

#include <optional>

#include <Eigen/Core>

#include "contact/contact_patch.hpp"

namespace microslip::contact {

class ModalContactField {
 public:
  /// @param p, r     coordinates of the samples in the patch plane [m], n each.
  /// @param weights  area weights of the samples [m²], n.
  /// @param shapes   values there, n × n_modes each.
  /// @param degree   total degree of the basis; without a value it is chosen by leave-one-out
  ///                 cross-validation. A degree the samples cannot carry is lowered (see degree()).
  ModalContactField(const Eigen::VectorXd& p, const Eigen::VectorXd& r,
                    const Eigen::VectorXd& weights, const ModalShapes& shapes,
                    std::optional<int> degree);

  [[nodiscard]] ModalShapes at(const Eigen::VectorXd& p, const Eigen::VectorXd& r) const;
  [[nodiscard]] int degree() const { return degree_; }
  /// Leave-one-out error of each mode relative to its own rms size over u, v and w [-], n_modes.
  [[nodiscard]] const Eigen::VectorXd& fit_error() const { return fit_error_; }

 private:
  int degree_ = 0;
  Eigen::VectorXd fit_error_;
};

}  // namespace microslip::contact
