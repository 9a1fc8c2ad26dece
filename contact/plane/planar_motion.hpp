/// @file
/// What a planar slider sees: the motion of one contact point at any phase, and the disc that drags
/// the slider along, free of units.
///
///   x(θ) = (u, w) without means,   n = N(v),   |f| ≤ μ n,   f = g K (x − s)                   (1)
///   |K (x − s)| ≤ r(θ),   r = μ n / g,   K = diag(k_u, k_w h)                                 (2)
///
/// (2) holds for every surface law: g = g_p, stiffness that depends on the load, enters through r
/// alone, and h = g_r/g_p is 1 except where bodies of unequal compliance stand in series with rough
/// surfaces. Lengths are counted in L₀ = F₀/k₀ and r in F₀, the force scale of the cycle, so that K
/// and the numbers in (2) are of order one.
///
/// A direction without stiffness carries no friction: its motion is taken away and its force is
/// zero.
///
/// Source: theory sections 3, 9, 10, 11.
#pragma once

#include <Eigen/Core>

#include "contact/harmonics.hpp"
#include "contact/surface/surface_law.hpp"

namespace microslip::contact {

/// r / F₀ where contact leaves less of it. The slider follows the motion without memory there, s' ∥
/// x' to the square root of this, and forces are limit · e: any r below it gives the same e, this
/// one without products that underflow (fourth powers of it times ratios of stiffness down to 1e-60
/// are normal numbers).
inline constexpr double least_radius = 1e-60;

/// One phase. Rates are with respect to θ.
struct PlanarInstant {
  double phase = 0.0;
  Eigen::Vector2d position = Eigen::Vector2d::Zero();   ///< x / L₀
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();   ///< x' / L₀
  Eigen::Vector2d stiffness = Eigen::Vector2d::Ones();  ///< K L₀/F₀, diagonal, both > 0
  Eigen::Vector2d stiffness_rate = Eigen::Vector2d::Zero();
  Eigen::Vector2d stiffness_by_approach = Eigen::Vector2d::Zero();  ///< [1/m]
  double approach_rate = 0.0;                                       ///< v' [m]
  SurfaceState surface;                                             ///< in units of the law
  double limit = 0.0;                                               ///< μ n/g / F₀
  double radius = 0.0;                                              ///< r / F₀, see least_radius
  double radius_rate = 0.0;                                         ///< r' / F₀
  double radius_by_approach = 0.0;                                  ///< ∂r/∂v / F₀ [1/m]
  double radius_by_rate = 0.0;                                      ///< ∂r/∂σ / F₀ [s/m]
  double speed = 0.0;                                               ///< hypot(u', w') [m]
  Eigen::Vector2d heading = Eigen::Vector2d::Zero();                ///< (u', w') / speed; 0 at rest

  /// K (x − s) / F₀: the force of a slider, but for g.
  [[nodiscard]] Eigen::Vector2d force(const Eigen::Vector2d& slider) const {
    return stiffness.cwiseProduct(position - slider);
  }
  /// The same of a slider at rest, at most what friction holds: of a limit below rounding of x − s
  /// nothing else is known.
  [[nodiscard]] Eigen::Vector2d held_force(const Eigen::Vector2d& slider) const {
    const Eigen::Vector2d whole = force(slider);
    const double size = whole.norm();
    return size > limit ? Eigen::Vector2d(whole * (limit / size)) : whole;
  }
  /// Its rate while the slider rests.
  [[nodiscard]] Eigen::Vector2d force_rate(const Eigen::Vector2d& slider) const {
    return stiffness.cwiseProduct(velocity) + stiffness_rate.cwiseProduct(position - slider);
  }
  /// Half-axes r/K of the ellipse of the slider, / L₀.
  [[nodiscard]] Eigen::Vector2d reach() const { return radius * stiffness.cwiseInverse(); }
  [[nodiscard]] Eigen::Vector2d reach_rate() const {
    return (radius_rate - radius * stiffness_rate.array() / stiffness.array()) / stiffness.array();
  }
  /// The slider at the edge of its ellipse from which the force acts along a direction.
  [[nodiscard]] Eigen::Vector2d edge(const Eigen::Vector2d& direction) const {
    return position - reach().cwiseProduct(direction);
  }
};

class PlanarMotion {
 public:
  /// @param law     of the point; kept by reference.
  /// @param motion  u, v, w [m], H ≥ 1; kept by reference.
  PlanarMotion(const SurfaceLaw& law, const Harmonics& motion, double frequency);

  [[nodiscard]] PlanarInstant at(double phase) const;
  /// As at(), with the derivatives of the law taken at phase + nudge: the side that is meant where
  /// the law has a kink.
  [[nodiscard]] PlanarInstant at(double phase, double nudge) const;
  /// x'' of both directions, whether they carry friction or not [m].
  [[nodiscard]] Eigen::Vector2d tangential_acceleration(double phase) const;

  /// False where no friction acts: μ = 0, no stiffness, no load, forces below the smallest doubles.
  [[nodiscard]] bool has_friction() const { return force_scale_ > 0.0; }
  [[nodiscard]] double force_scale() const { return force_scale_; }  ///< F₀ [Pa]
  /// Twice the smaller of k a and max μn/g, / F₀: the size of friction, at most 1;
  /// 0 without friction.
  [[nodiscard]] double friction_share() const { return friction_share_; }
  [[nodiscard]] double length_scale() const { return length_scale_; }  ///< L₀ [m]
  /// K₀ L₀/F₀, diagonal, both > 0: of full contact, a measure of lengths as forces.
  [[nodiscard]] const Eigen::Vector2d& stiffness() const { return stiffness_; }
  /// Which directions carry friction: 1 or 0 along p, r.
  [[nodiscard]] const Eigen::Vector2d& active() const { return active_; }
  /// Virgin slider, s = 0: −(u₀, w₀)/L₀ beside the moving part of the motion.
  [[nodiscard]] Eigen::Vector2d virgin_slider() const;
  [[nodiscard]] int n_harmonics() const { return harmonics_.n_harmonics(); }
  [[nodiscard]] const Harmonics& harmonics() const { return harmonics_; }
  [[nodiscard]] const SurfaceLaw& law() const { return law_; }
  [[nodiscard]] double frequency() const { return frequency_; }

 private:
  void set_scales();

  const SurfaceLaw& law_;
  const Harmonics& harmonics_;
  double frequency_;
  bool is_smooth_;
  bool depends_on_rate_;
  double mean_approach_;
  double force_scale_ = 0.0;
  double per_force_ = 1.0;
  double friction_share_ = 0.0;
  double length_scale_ = 1.0;
  Eigen::Vector2d stiffness_ = Eigen::Vector2d::Ones();
  Eigen::Vector2d active_ = Eigen::Vector2d::Ones();
  Eigen::Vector2d per_length_ = Eigen::Vector2d::Ones();  ///< 1/L₀, 0 where no friction acts
};

}  // namespace microslip::contact
