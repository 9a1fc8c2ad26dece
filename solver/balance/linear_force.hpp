/// @file
/// A linear spring between the modes as a ModalForce: the free and the stuck limit of a contact walk
/// the same way as the contact itself.
#pragma once

#include <utility>

#include "contact/modal_force.hpp"

namespace microslip::solver {

class LinearForce final : public contact::ModalForce {
 public:
  /// @param stiffness  S [1/s²], n_modes × n_modes: G^(k) = S A^(k).
  /// @param report     what every cycle is said to be.
  LinearForce(Eigen::MatrixXd stiffness, const contact::CycleReport& report)
      : stiffness_(std::move(stiffness)), report_(report) {}
  /// In the place of a contact that is known to be linear: its reports are the contact's own.
  /// @param contact  borrowed.
  LinearForce(Eigen::MatrixXd stiffness, const contact::ModalForce& contact)
      : stiffness_(std::move(stiffness)), contact_(&contact) {}

  [[nodiscard]] Eigen::Index n_modes() const override { return stiffness_.rows(); }
  [[nodiscard]] Eigen::MatrixXd stuck_stiffness() const override { return stiffness_; }
  [[nodiscard]] contact::CycleReport report(const contact::Harmonics& q,
                                            double frequency) const override {
    return contact_ != nullptr ? contact_->report(q, frequency) : report_;
  }
  [[nodiscard]] contact::ForceAndJacobian evaluate(const contact::Harmonics& q,
                                                   double /*frequency*/) const override {
    contact::ForceAndJacobian result;
    result.force = q;
    result.force.rows() = q.rows() * stiffness_.transpose();
    const Eigen::Index size = q.rows().size();
    const Eigen::Index n = n_modes();
    result.jacobian = Eigen::MatrixXd::Zero(size, size);
    for (Eigen::Index i = 0; i < size; i += n) result.jacobian.block(i, i, n, n) = stiffness_;
    result.frequency_derivative = Eigen::VectorXd::Zero(size);
    return result;
  }

 private:
  Eigen::MatrixXd stiffness_;
  contact::CycleReport report_;
  const contact::ModalForce* contact_ = nullptr;
};

}  // namespace microslip::solver
