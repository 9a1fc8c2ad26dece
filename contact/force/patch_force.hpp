/// @file
/// Modal force of a friction patch whose points move along p with one harmonic, on plain surfaces:
/// field → point cycles in closed form → modal force and exact Jacobian by quadrature over the
/// points (theory section 13).
///
///   ∂G/∂q = Σ_i w_i Φ_iᵀ J_i Φ_i,      J_i the 6 × 6 Jacobian of the point
///
/// Points are taken in blocks: one cycle per point, then the modal Jacobian by dense products, mode
/// pair by mode pair. Blocks in which nothing slips or separates leave out what is zero there. The
/// cost of a point is about that of its Jacobian entries: 22 products for each pair of modes.
#pragma once

#include <span>
#include <vector>

#include "contact/force/pointwise_force.hpp"
#include "contact/patch/contact_patch.hpp"
#include "contact/point/point_motion.hpp"

namespace microslip::contact {

class PatchForce : public PointwiseForce {
 public:
  /// @param patch   points, n_points.
  /// @param shapes  relative mode shapes at the points, n_points × n_modes; w is not used.
  /// @throws std::invalid_argument  sizes differ or a value is not finite.
  PatchForce(ContactPatch patch, ModalShapes shapes);

 private:
  /// The force does not depend on the frequency.
  /// @throws std::invalid_argument  more harmonics than one, of the motion or of the force.
  [[nodiscard]] ForceAndJacobian awake_force(double frequency, const Asked& asked,
                                             PointwiseWork& work) const override;
  void add_cycles(std::span<const Eigen::Index> points, double frequency, PointwiseWork& work,
                  ReportSum& sum) const override;

  ContactPatch patch_;
};

}  // namespace microslip::contact
