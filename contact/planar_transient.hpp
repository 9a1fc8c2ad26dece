/// @file
/// A friction patch in time whose points slide in a plane and obey any SurfaceLaw: rough surfaces,
/// friction by speed, another stiffness along r (theory sections 9 to 11). The one-directional smooth
/// patch is patch_transient.hpp.
///
///   K₀ (x − s) = r e in slip,   |K₀ (x − s)| ≤ r,   r = μ n/g,   f = g K₀ (x − s)          (1)
///   G = Σ_i w_i [ φ_u f_p + φ_v (n − n_ref) + φ_w f_r ]_i                                  (2)
///
/// with x = (u, w), K₀ = diag(k_u, k_w) and C = K₀⁻¹. In slip the direction e(α) is a state of its own:
/// from s' ∥ e, s = x − r C e and with d = x' − r' C e
///
///   α' = e_⊥·d / (r e_⊥·C e_⊥),      ρ = e·d − (e·C e_⊥/e_⊥·C e_⊥) e_⊥·d                     (3)
///
/// where k_u = k_w: μ n α' = f-stiffness times x'·e_⊥, ρ = x'·e − r'/k. Slip ends when its rate ρ falls
/// to 0. α is the internal variable of the point. (3) is singular where contact begins and ends; there r is
/// replaced by hypot(r, ε), ε a hundred-thousandth of K₀ times the motion: the direction matters to the
/// force by r only, so that it errs by ε² of its size.
///
/// σ, the speed that μ(σ) sees, is |x'| (section 10); r' then holds x''. Where smooth surfaces part (1)
/// goes on with a negative load until the integrator has located it.
///
/// Guards: stick r − |K₀(x − s)|, load; slip ρ, load; separated −load; each against the size of its terms.
/// Friction without coefficient slips in no direction; without stiffness it does not act and counts as
/// stuck in contact; a point of weight 0 never changes state.
#pragma once

#include <vector>

#include "contact/contact_patch.hpp"
#include "contact/surface_law.hpp"
#include "contact/transient_force.hpp"

namespace microslip::contact {

class PlanarTransient final : public TransientForce {
 public:
  /// @param weights  of the points, n_points, ≥ 0.   @param laws  n_points.
  /// @param shapes   relative mode shapes at the points, n_points × n_modes; w without elements: nothing
  ///                 moves along r.
  /// @throws std::invalid_argument  sizes differ or a value is not finite.
  PlanarTransient(Eigen::VectorXd weights, std::vector<SurfaceLaw> laws, ModalShapes shapes);

  [[nodiscard]] Eigen::Index n_modes() const override { return shapes_.u.cols(); }
  [[nodiscard]] Eigen::Index n_points() const override { return weights_.size(); }
  [[nodiscard]] TransientMemory virgin_memory() const override;
  /// The return (I + λK₀)⁻¹ f* of theory section 9.
  [[nodiscard]] Eigen::VectorXd trial_force(const ModalMotion& motion,
                                            const TransientMemory& memory) const override;
  double commit(const ModalMotion& motion, TransientMemory& memory) const override;
  [[nodiscard]] Eigen::VectorXd held_force(const ModalMotion& motion,
                                           const TransientMemory& memory) const override;
  [[nodiscard]] Eigen::Index n_internal() const override { return n_points(); }
  [[nodiscard]] Eigen::VectorXd internal_rates(const ModalMotion& motion,
                                               const TransientMemory& memory,
                                               const GuardScale& scale) const override;
  [[nodiscard]] Eigen::VectorXd internal_weights(const ModalMotion& motion,
                                                 const TransientMemory& memory,
                                                 const GuardScale& scale) const override;
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
  [[nodiscard]] StateShares shares(const TransientMemory& memory) const override;
  /// ∫ (φ_u k_u φ_uᵀ + φ_v k_v φ_vᵀ + φ_w k_w φ_wᵀ) dA, all in full contact; without friction normally only.
  [[nodiscard]] Eigen::MatrixXd stuck_stiffness() const override;

 private:
  struct Motions;  // of all points, or of one
  struct Instant;  // one point and what its law makes of it
  struct Point {
    SurfaceLaw law;
    Eigen::Vector2d stiffness;   // K₀, 1 where there is none
    Eigen::Vector2d compliance;  // C
    Eigen::Vector2d active;      // 1 or 0: which directions carry friction
    double touch;                // approach where contact begins [m]; NaN: nowhere
    double load_size;            // of the load at rest [Pa]
    double tangential_size;      // ‖φ_u‖ + ‖φ_w‖
    double normal_size;          // ‖φ_v‖
    bool slides;                 // μ > 0
    bool rubs;                   // and some stiffness
  };
  [[nodiscard]] Point make_point(const SurfaceLaw& law, Eigen::Index row) const;
  [[nodiscard]] Motions all_motions(const ModalMotion& motion) const;
  [[nodiscard]] Motions motion_of(Eigen::Index point, const ModalMotion& motion) const;
  [[nodiscard]] Guards guards_at(Eigen::Index point, const Instant& now,
                                 const TransientMemory& memory, const GuardScale& scale) const;
  [[nodiscard]] Eigen::VectorXd modal_force(Eigen::MatrixX3d tractions) const;

  Eigen::VectorXd weights_;
  ModalShapes shapes_;
  std::vector<Point> points_;
};

}  // namespace microslip::contact
