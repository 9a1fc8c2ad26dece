/// @file
/// A force that sees the modes through fewer coordinates x = T q (theory 14.2):
///
///   G(q) = Tᵀ G_x(T q),     ∂G/∂q = Tᵀ (∂G_x/∂x) T
///
/// Patches are small and stiff beside the body: some six coordinates move them as fourteen mode
/// shapes do.
#pragma once

#include <memory>

#include "contact/modal_force.hpp"

namespace microslip::contact {

class FewerCoordinates final : public ModalForce {
 public:
  /// @param of_modes  T, r × n_modes.
  /// @param force     of r modes.
  /// @throws std::invalid_argument  another number of modes than r.
  FewerCoordinates(Eigen::MatrixXd of_modes, std::unique_ptr<ModalForce> force);

  /// That of the force it asks.
  [[nodiscard]] std::unique_ptr<Workspace> workspace() const override;
  [[nodiscard]] CycleReport report(const Harmonics& q, double frequency,
                                   Workspace& work) const override;
  [[nodiscard]] double work_error(const Harmonics& q, double frequency,
                                  Workspace& work) const override;
  void states(const Harmonics& q, double frequency, ContactStates& result,
              Workspace& work) const override;
  [[nodiscard]] Eigen::MatrixXd stuck_stiffness() const override;
  [[nodiscard]] LinearState linear_state_of(const MotionSet& motions) const override;

 private:
  [[nodiscard]] ForceAndJacobian evaluated(const Harmonics& q, double frequency, const Asked& asked,
                                           Workspace& work) const override;
  [[nodiscard]] Harmonics coordinates(const Harmonics& q) const;

  Eigen::MatrixXd of_modes_;
  double norm_;  // of T, spectral
  std::unique_ptr<const ModalForce> force_;
};

}  // namespace microslip::contact
