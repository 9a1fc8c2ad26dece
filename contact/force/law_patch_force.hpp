/// @file
/// Modal force of a friction patch whose points follow any law (point_law.hpp), for any number of
/// harmonics and both tangential directions (theory section 13):
///
///   G^(k)_m = Σ_i w_i [ φ_u,im f_p,i + φ_v,im (n_i − n_ref,i δ_k0) + φ_w,im f_r,i ]^(k)
///   ∂G/∂q   = Σ_i w_i Φ_iᵀ J_i Φ_i,      J_i the Jacobian of the point
///
/// PatchForce does the same faster where the closed form of one harmonic and one tangential direction is
/// enough.
///
/// Points proved stuck or open cost next to nothing (sleeping_laws.hpp).
#pragma once

#include <memory>
#include <vector>

#include "contact/contact_patch.hpp"
#include "contact/force/law_projection.hpp"
#include "contact/force/sleeping_laws.hpp"
#include "contact/modal_force.hpp"
#include "contact/point/point_law.hpp"

namespace microslip::contact {

class LawPatchForce final : public ModalForce {
 public:
  /// @param weights  area of each point [m²], n ≥ 1, ≥ 0.
  /// @param laws     one per point, n; shared by patches of one scene.
  /// @param shapes   relative mode shapes at the points, n × n_modes; w may be empty (no motion along r).
  /// @throws std::invalid_argument  sizes differ or a value is not finite.
  LawPatchForce(Eigen::VectorXd weights, std::vector<std::shared_ptr<const PointLaw>> laws,
                ModalShapes shapes);

  [[nodiscard]] Eigen::Index n_modes() const override { return shapes_.u.cols(); }
  /// Equal input gives equal bits, whatever was asked before. Not for two threads at a time.
  /// @throws std::invalid_argument  another number of modes, or no harmonic.
  [[nodiscard]] ForceAndJacobian evaluate(const Harmonics& q, double frequency) const override;
  /// Points cost what all harmonics of q do, their sum over the patch what the rows do.
  /// @throws std::invalid_argument  as evaluate().
  [[nodiscard]] ForceAndJacobian evaluate_rows(
      const Harmonics& q, double frequency, const std::vector<Eigen::Index>& rows) const override;
  /// @throws std::invalid_argument  as evaluate().
  [[nodiscard]] Harmonics force_up_to(const Harmonics& q, double frequency,
                                      int n_harmonics) const override;
  /// @throws std::invalid_argument  as evaluate().
  [[nodiscard]] CycleReport report(const Harmonics& q, double frequency) const override;
  [[nodiscard]] Eigen::MatrixXd stuck_stiffness() const override;
  /// At another motion than the last one: costs its evaluation, without derivatives by the modes.
  /// @throws std::invalid_argument  as evaluate().
  void states(const Harmonics& q, double frequency, ContactStates& result) const override;
  /// Of any number of harmonics; unknown where a law does not know its linear range. See linear_proof.hpp.
  [[nodiscard]] LinearState linear_state(const Harmonics& centre, double radius) const override;

 private:
  void begin_states(const Harmonics& q, double frequency) const;

  Eigen::VectorXd weights_;
  std::vector<std::shared_ptr<const PointLaw>> laws_;
  ModalShapes shapes_;
  std::vector<const Eigen::MatrixXd*> shape_;  // of u, v and, unless empty, w
  // Storage, and sums that depend on who sleeps alone.
  mutable SleepingLaws sleep_;
  mutable PatchMotion motion_;
  mutable Harmonics point_motion_;
  mutable PointTraction traction_;
  mutable LawProjection sum_;
  mutable ContactStates all_states_;  // of the motion evaluated last, points without area included
  mutable Harmonics states_q_;
  mutable double states_frequency_ = 0.0;
};

}  // namespace microslip::contact
