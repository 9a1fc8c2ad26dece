/// @file
/// A friction patch in time: points with one tangential direction under a varying load, smooth
/// surfaces and a constant coefficient (theory sections 2, 3):
///
///   n = max(0, n₀' + k_v v),   f = k_u (u − s),   |f| ≤ μ n,   s moves only where |f| = μ n
///   G = Σ_i w_i [ φ_u,i f_i + φ_v,i (n_i − n_ref,i) ],          n_ref = max(n₀', 0)
///
/// Guards, each divided by the size of the terms it is the difference of:
///
///   stick       μn − f, μn + f
///   slip ±      ±k_u u̇ − μ k_v v̇ (the slip rate), n
///   separated   −(n₀' + k_v v)
///   slip        n (μ = 0: slips in no direction in particular)
///
/// A point with k_u = 0 carries no friction and counts as stuck wherever it is in contact; a point
/// of weight 0 never changes state.
#pragma once

#include <vector>

#include "contact/patch/contact_patch.hpp"
#include "contact/transient/pointwise_transient.hpp"

namespace microslip::contact {

class PatchTransient final : public PointwiseTransient {
 public:
  /// @param patch   points, n_points.
  /// @param shapes  relative mode shapes at the points, n_points × n_modes; w is not used.
  /// @throws std::invalid_argument  sizes differ or a value is not finite.
  PatchTransient(const ContactPatch& patch, ModalShapes shapes);

  [[nodiscard]] Eigen::VectorXd trial_force(const ModalMotion& motion,
                                            const TransientMemory& memory) const override;
  double commit(const ModalMotion& motion, TransientMemory& memory) const override;
  [[nodiscard]] Eigen::VectorXd held_force(const ModalMotion& motion,
                                           const TransientMemory& memory) const override;
  [[nodiscard]] bool is_held_linear() const override { return true; }
  [[nodiscard]] Eigen::Matrix<double, Eigen::Dynamic, guards_per_point> guards(
      const ModalMotion& motion, const TransientMemory& memory,
      const GuardScale& scale) const override;
  [[nodiscard]] Guards guards_of(Eigen::Index point, const ModalMotion& motion,
                                 const TransientMemory& memory,
                                 const GuardScale& scale) const override;
  void switch_state(Eigen::Index point, const ModalMotion& motion,
                    TransientMemory& memory) const override;
  [[nodiscard]] double slip_power(const ModalMotion& motion,
                                  const TransientMemory& memory) const override;
  /// ∫ (φ_u k_u φ_uᵀ + φ_v k_v φ_vᵀ) dA; a point without friction (μ = 0) resists normally only.
  [[nodiscard]] Eigen::MatrixXd stuck_stiffness() const override;

 private:
  struct Instant;  // motion of one point
  [[nodiscard]] Instant instant(Eigen::Index point, const ModalMotion& motion) const;
  [[nodiscard]] Guards guards_at(Eigen::Index point, const Instant& now, ContactState state,
                                 double slider, const GuardScale& scale) const;
  [[nodiscard]] Eigen::VectorXd modal_force(const Eigen::VectorXd& friction,
                                            const Eigen::VectorXd& normal) const;

  std::vector<PointParameters> points_;
  Eigen::VectorXd u_size_;  // ‖φ_u‖ of each point
  Eigen::VectorXd v_size_;
};

}  // namespace microslip::contact
