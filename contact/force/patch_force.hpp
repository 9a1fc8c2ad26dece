/// @file
/// Modal force of a friction patch: field → point cycles → modal force and exact Jacobian by
/// quadrature over the points (theory section 13).
///
///   G_n^s = Σ_i w_i [ φ_u,in f_s,i + φ_v,in n_s,i ],       G_n^c likewise
///   G_b,n = Σ_i w_i [ φ_u,in f_b,i + φ_v,in (n_b,i − n_ref,i) ],    n_ref = max(n₀', 0)
///
/// and ∂G/∂q = Σ_i w_i Φ_iᵀ J_i Φ_i with the 6 × 6 Jacobian J_i of the point.
///
/// Points are taken in blocks: motion of a block by dense products, one cycle per point, then the
/// modal Jacobian by dense products again, mode pair by mode pair. Blocks in which nothing slips or
/// separates leave out what is zero there. The cost of a point is about that of its Jacobian entries:
/// 22 products for each pair of modes. Points proved stuck or open cost nothing (sleeping_points.hpp).
#pragma once

#include <vector>

#include "contact/contact_patch.hpp"
#include "contact/force/sleeping_points.hpp"
#include "contact/modal_force.hpp"

namespace microslip::contact {

class PatchForce final : public ModalForce {
 public:
  /// @param patch   points, n_points.
  /// @param shapes  relative mode shapes at the points, n_points × n_modes; w is not used.
  /// @throws std::invalid_argument  sizes differ or a value is not finite.
  PatchForce(ContactPatch patch, ModalShapes shapes);

  [[nodiscard]] CycleReport report(const Harmonics& q, double frequency) override;
  /// ∫ (φ_u k_u φ_uᵀ + φ_v k_v φ_vᵀ) dA; a point without friction (μ = 0) resists normally only.
  [[nodiscard]] Eigen::MatrixXd stuck_stiffness() const override;
  /// See linear_proof.hpp.
  [[nodiscard]] LinearState linear_state(const Harmonics& centre, double radius) const override;

  void states(const Harmonics& q, double frequency, ContactStates& result) override;

  [[nodiscard]] const ContactPatch& patch() const { return patch_; }
  [[nodiscard]] const ModalShapes& shapes() const { return shapes_; }

 private:
  /// H = 1. The force does not depend on the frequency. Which points sleep depends on the motions seen
  /// before, so that equal input gives equal numbers to rounding, and equal bits after equal histories.
  [[nodiscard]] ForceAndJacobian evaluated(const Harmonics& q, double frequency,
                                           const Asked& asked) override;

  ContactPatch patch_;
  ModalShapes shapes_;
  SleepingPoints sleep_;
  // In the order of sleep_: [block][u, v][mode][point of the block], padded with zeros.
  std::vector<double> blocks_;
  Eigen::MatrixX3d u_, v_;  // motion of the points, for states()
};

}  // namespace microslip::contact
