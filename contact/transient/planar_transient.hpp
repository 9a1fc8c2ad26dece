/// @file
/// A friction patch in time whose points slide in a plane and obey any SurfaceLaw: rough surfaces,
/// friction by speed, another stiffness along r (theory sections 9 to 11). The patch of smooth
/// surfaces with one direction is patch_transient.hpp, that of one point planar_point.hpp.
///
///   G = Σ_i w_i [ φ_u f_p + φ_v (n − n_ref) + φ_w f_r ]_i
///
/// In slip the direction angle α of f is a state of its own, the internal variable of the point.
/// Its rate is singular where contact begins and ends, r = 0. There, and where
/// r stays below ε = 5e-4 of K₀ times the motion, the direction is given the time that an r of that
/// size takes (planar_point.hpp, eq. 3), so that steps need not be shorter than ε of a cycle.
/// Direction matters to the force by r only: amplitudes err by less than 1e-8 for it,
/// falling at least with ε³.
///
/// Guards: stick r − |K(x − s)|, load; slip ρ, load; separated −load; each against the size of its
/// terms. Without friction coefficient a point slips in no direction; without stiffness it carries
/// no friction and counts as stuck in contact; a point of weight 0 never changes state.
#pragma once

#include <vector>

#include "contact/plane/planar_point.hpp"
#include "contact/transient/pointwise_transient.hpp"

namespace microslip::contact {

class PlanarTransient final : public PointwiseTransient {
 public:
  /// @param weights  of the points, n_points, ≥ 0.   @param laws  n_points.
  /// @param shapes   relative mode shapes at the points, n_points × n_modes; w without elements:
  ///                 nothing moves along r.
  /// @throws std::invalid_argument  sizes differ or a value is not finite.
  PlanarTransient(Eigen::VectorXd weights, std::vector<SurfaceLaw> laws, ModalShapes shapes);

  /// The return (I + λK)⁻¹ f* of theory section 9.
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
  /// Of cubic heights: the approach beyond which all are in contact, over their height.
  [[nodiscard]] Eigen::VectorXd kink_distances(const ModalMotion& motion) const override;
  void switch_state(Eigen::Index point, const ModalMotion& motion,
                    TransientMemory& memory) const override;
  [[nodiscard]] double slip_power(const ModalMotion& motion,
                                  const TransientMemory& memory) const override;
  /// ∫ (φ_u k_u φ_uᵀ + φ_v k_v φ_vᵀ + φ_w k_w φ_wᵀ) dA, all in full contact;
  /// without friction normally only.
  [[nodiscard]] Eigen::MatrixXd stuck_stiffness() const override;

 private:
  struct Motions;  // of all points
  [[nodiscard]] Motions all_motions(const ModalMotion& motion) const;
  [[nodiscard]] PlanarPointInstant instant_at(Eigen::Index point, const ModalMotion& motion,
                                              double least_approach) const;
  [[nodiscard]] Guards guards_at(Eigen::Index point, const PlanarPointInstant& now,
                                 const TransientMemory& memory, const GuardScale& scale) const;
  void touch_down(Eigen::Index point, const ModalMotion& motion, TransientMemory& memory) const;
  [[nodiscard]] Eigen::VectorXd modal_force(Eigen::MatrixX3d tractions) const;

  /// A kink of the law of a point that is not an end of its contact.
  struct Kink {
    Eigen::Index point;
    double approach;  ///< [m]
    double width;     ///< from first touch to there [m]
  };

  std::vector<PlanarPoint> points_;
  std::vector<Kink> kinks_;
};

}  // namespace microslip::contact
