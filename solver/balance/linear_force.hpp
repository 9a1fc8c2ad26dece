/// @file
/// A linear spring between the modes as a ModalForce: the free and the stuck limit of a contact
/// walk the same way as the contact itself.
#pragma once

#include <algorithm>
#include <memory>
#include <utility>

#include "contact/modal_force.hpp"

namespace microslip::solver {

class LinearForce final : public contact::ModalForce {
 public:
  /// @param stiffness  S [1/s²], n_modes × n_modes: G^(k) = S A^(k).
  /// @param report     what every cycle is said to be.
  LinearForce(Eigen::MatrixXd stiffness, const contact::CycleReport& report)
      : ModalForce(stiffness.rows()), stiffness_(std::move(stiffness)), report_(report) {}
  /// In the place of a contact that is known to be linear: its reports are the contact's own, and a
  /// mean that the contact does not answer no spring holds.
  /// @param contact  borrowed.
  LinearForce(Eigen::MatrixXd stiffness, const contact::ModalForce& contact)
      : ModalForce(stiffness.rows()), stiffness_(std::move(stiffness)), contact_(&contact) {}

  [[nodiscard]] Eigen::MatrixXd stuck_stiffness() const override { return stiffness_; }
  /// That of the contact, which reports.
  [[nodiscard]] std::unique_ptr<Workspace> workspace() const override {
    return contact_ != nullptr ? contact_->workspace() : ModalForce::workspace();
  }
  [[nodiscard]] contact::CycleReport report(const contact::Harmonics& q, double frequency,
                                            Workspace& work) const override {
    return contact_ != nullptr ? contact_->report(q, frequency, work) : report_;
  }
  [[nodiscard]] bool answers_mean() const override {
    return contact_ == nullptr || contact_->answers_mean();
  }
  /// The free limit, or one of contact that sticks, whatever the motion.
  [[nodiscard]] contact::LinearState linear_state_of(
      const contact::MotionSet& /*motions*/) const override {
    return stiffness_.isZero(0.0) ? contact::LinearState::free : contact::LinearState::stuck;
  }

 private:
  [[nodiscard]] contact::ForceAndJacobian evaluated(const contact::Harmonics& q,
                                                    double /*frequency*/,
                                                    const contact::Asked& asked,
                                                    Workspace& /*work*/) const override {
    contact::ForceAndJacobian result;
    result.force = contact::Harmonics(std::max(q.n_harmonics(), asked.n_harmonics), n_modes());
    result.force.rows().topRows(q.rows().rows()) = q.rows() * stiffness_.transpose();
    const Eigen::Index n = n_modes();
    const Eigen::Index size = static_cast<Eigen::Index>(asked.rows.size()) * n;
    result.jacobian = Eigen::MatrixXd::Zero(size, size);
    for (Eigen::Index i = 0; i < size; i += n) result.jacobian.block(i, i, n, n) = stiffness_;
    if (!answers_mean()) {
      result.force.rows().row(0).setZero();
      if (size > 0 && asked.rows.front() == 0) result.jacobian.topLeftCorner(n, n).setZero();
    }
    result.frequency_derivative = Eigen::VectorXd::Zero(size);
    return result;
  }

  Eigen::MatrixXd stiffness_;
  contact::CycleReport report_;
  const contact::ModalForce* contact_ = nullptr;
};

}  // namespace microslip::solver
