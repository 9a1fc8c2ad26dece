/// @file
/// A force that sees a motion about its mean, without `mean_coupling`: the load varies about that
/// of rest wherever the mean lies.
///
///   G(B, A) = G(0, A),     ∂G/∂B = 0
///
/// The mean of the force stays, so that the balance gives the mean that nothing of the contact
/// answers: Ω B = Q_b − G_b(0, A).
#pragma once

#include <memory>

#include "contact/modal_force.hpp"

namespace microslip::contact {

/// The same with mean zero.
[[nodiscard]] Harmonics without_mean(Harmonics q);

class VibrationAlone final : public ModalForce {
 public:
  /// @param force  asked at mean zero.
  explicit VibrationAlone(std::unique_ptr<ModalForce> force);

  /// That of the force it asks.
  [[nodiscard]] std::unique_ptr<Workspace> workspace() const override;
  [[nodiscard]] CycleReport report(const Harmonics& q, double frequency,
                                   Workspace& work) const override;
  [[nodiscard]] double work_error(const Harmonics& q, double frequency,
                                  Workspace& work) const override;
  void states(const Harmonics& q, double frequency, ContactStates& result,
              Workspace& work) const override;
  [[nodiscard]] Eigen::MatrixXd stuck_stiffness() const override;
  [[nodiscard]] bool answers_mean() const override { return false; }
  /// Of the harmonics above the mean.
  [[nodiscard]] LinearState linear_state_of(const MotionSet& motions) const override;

 private:
  [[nodiscard]] ForceAndJacobian evaluated(const Harmonics& q, double frequency, const Asked& asked,
                                           Workspace& work) const override;

  std::unique_ptr<const ModalForce> force_;
};

}  // namespace microslip::contact
