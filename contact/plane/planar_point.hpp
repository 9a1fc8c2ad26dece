/// @file
/// One contact point in time that slides in a plane: what its law makes of position and speed at an
/// instant, and how fast slider and direction of slip move (theory section 9).
///
///   K (x − s) = r e in slip,   |K (x − s)| ≤ r,   r = μ n/g,   f = g K (x − s)             (1)
///
/// with x = (u, w), K = diag(k_u, k_w h), C = K⁻¹. g = g_p is the share of the stiffness along p
/// that the load leaves rough surfaces, h = g_r/g_p is 1 except where bodies of unequal compliance
/// stand in series with them (surface_law.hpp). From s' ∥ e,
/// s = x − r C e and with d = x' − (r C)' e
///
///   α' = e_⊥·d / (r e_⊥·C e_⊥),      ρ = e·d − (e·C e_⊥/e_⊥·C e_⊥) e_⊥·d                     (2)
///
/// σ, the speed that μ(σ) sees, is |x'| (theory section 10); r' then holds x''. (r C)' holds h'.
/// Where smooth surfaces part (1) goes on with a negative load,
/// so that it is smooth until the end has been located.
#pragma once

#include <limits>

#include <Eigen/Core>

#include "contact/surface/surface_law.hpp"

namespace microslip::contact {

/// A law with what does not change in time.
struct PlanarPoint {
  /// @param tangential_size  ‖φ_u‖ + ‖φ_w‖.   @param normal_size  ‖φ_v‖.
  /// @param moves_along_r    false: friction acts along p alone.
  PlanarPoint(const SurfaceLaw& surface, double tangential_size, double normal_size,
              bool moves_along_r);

  SurfaceLaw law;
  Eigen::Vector2d stiffness;  ///< K of full contact, h = 1 [N/m³], 1 where there is none
  Eigen::Vector2d active;     ///< 1 or 0: which directions carry friction
  double touch;               ///< approach where contact begins [m]; NaN: nowhere
  double load_size;           ///< of the load at rest [Pa]
  double tangential_size;
  double normal_size;
  bool rubs;  ///< friction, and some stiffness to act through
};

/// Relative motion (u, v, w) of a point [m] and its rates by time;
/// `second` is 0 where nobody knows it.
struct PlanarPointMotion {
  Eigen::Vector3d value;
  Eigen::Vector3d rate;
  Eigen::Vector3d second;
};

struct PlanarPointInstant {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();        ///< x in active directions [m]
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();        ///< x' [m/s]
  Eigen::Vector2d acceleration = Eigen::Vector2d::Zero();    ///< x'' [m/s²]
  Eigen::Vector2d stiffness = Eigen::Vector2d::Ones();       ///< K [N/m³]
  Eigen::Vector2d stiffness_rate = Eigen::Vector2d::Zero();  ///< K' [N/m³/s]
  double load =
      0.0;  ///< that of smooth surfaces of the same stiffness [Pa]: its sign tells contact
  double normal = 0.0;       ///< n while in contact [Pa]
  double ratio = 1.0;        ///< g
  double radius = 0.0;       ///< r [Pa]
  double radius_rate = 0.0;  ///< r' [Pa/s]
};

/// @param least_approach  the law is seen at this approach [m] if it is further closed than the
///                        motion's.
[[nodiscard]] PlanarPointInstant instant_of(
    const PlanarPoint& point, const PlanarPointMotion& motion,
    double least_approach = -std::numeric_limits<double>::infinity());

/// Where contact begins, by as little inside that derivatives are those of the closed side [m].
[[nodiscard]] double just_inside(const PlanarPoint& point);

/// K (x − s) [Pa].
[[nodiscard]] Eigen::Vector2d spring_force(const PlanarPoint& point, const PlanarPointInstant& now,
                                           const Eigen::Vector2d& slider);

/// e(α).
[[nodiscard]] Eigen::Vector2d slip_direction(double angle);

/// ρ of (2) [m/s].
[[nodiscard]] double slip_speed(const PlanarPointInstant& now, double angle);

/// α where stick ends: the direction of the spring, and the more (3) would hold α back, the more
/// the one it settles in, e ∥ d,
///
///   (r/R) F/|F| + (1 − r/R) e_∞,     x' = (ρ_∞ I + (r C)') e_∞,   |e_∞| = 1                  (4)
///
/// An α that starts aside and lags would end slip that the point is far from ending; the stick
/// would end at once, a little farther round, and so on.
/// @param force  F = K (x − s) [Pa].   @param edge  as of turn_rate().
[[nodiscard]] double starting_angle(const PlanarPoint& point, const PlanarPointInstant& now,
                                    const Eigen::Vector2d& force, double edge);

/// α' of (2) [rad/s]; 0 along a line. Where r is small α follows the motion within r C/|x'|,
/// however short that is. There it is given more time, with the motion's own turning β' fed
/// forward,
///
///   α' = β' + (r α'₍₂₎ − r β')/R,     R = (r⁴ + edge⁴)^¼,     β' = x' × x''/|x'|²              (3)
///
/// which is (2) for r ≫ edge, follows the motion without delay else, and is regular at r = 0.
/// @param edge  [Pa], > 0.
[[nodiscard]] double turn_rate(const PlanarPoint& point, const PlanarPointInstant& now,
                               double angle, double edge);

}  // namespace microslip::contact
