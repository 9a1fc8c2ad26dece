/// @file
/// Modal force of a friction patch: field → point cycles → modal force and exact Jacobian by
/// quadrature over the points (theory section 13).
#pragma once

#include "contact/contact_patch.hpp"
#include "contact/modal_force.hpp"

namespace microslip::contact {

class PatchForce final : public ModalForce {
 public:
  /// @param patch   points, n_points.
  /// @param shapes  relative mode shapes at the points, n_points × n_modes.
  /// @throws std::invalid_argument  sizes differ or a value is not finite.
  PatchForce(ContactPatch patch, ModalShapes shapes);

  [[nodiscard]] Eigen::Index n_modes() const override;
  /// H = 1. @throws std::invalid_argument  another number of harmonics or modes.
  [[nodiscard]] ForceAndJacobian evaluate(const Harmonics& q, double frequency) const override;
  [[nodiscard]] CycleReport report(const Harmonics& q, double frequency) const override;
  [[nodiscard]] Eigen::MatrixXd stuck_stiffness() const override;

  [[nodiscard]] const ContactPatch& patch() const { return patch_; }
  [[nodiscard]] const ModalShapes& shapes() const { return shapes_; }

 private:
  ContactPatch patch_;
  ModalShapes shapes_;
};

}  // namespace microslip::contact
