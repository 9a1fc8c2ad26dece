/// @file
/// Preload of a patch as pressure per point (theory sections 2, 12): n₀' ≥ 0 presses, n₀' < 0 is a gap of
/// −n₀'/k_v. Fields come from resultants,
///
///   n = a + b p + c r,     ∬ n dA = F,    ∬ p n dA = M_r,    −∬ r n dA = M_p                        (1)
///
/// or from values per point (an expression, a table), which are scaled to a total or checked against it. The
/// total is the normal force that is carried at rest, n_ref = max(n₀', 0) (theory section 2; as the loads of
/// cells that have lifted off in section 12):
///
///   ∬ max(n, 0) dA = F                                                                                (2)
///
/// A gap pulls on nothing and does not count against it, as it would in ∬ n dA.
///
/// Moments turn about the axes p and r through the origin of the coordinates given, right-handed with
/// q = r × p: (x, y, z) of the contact area with moments is (q, r, p). (1) is the linear distribution as
/// it stands; a negative part of it is a gap and has to be resolved by unilateral equilibrium where the
/// preload is meant to press everywhere.
///
/// Integrals are sums over the points with their weights, so that (1) holds to rounding on any rule.
#pragma once

#include <Eigen/Core>

namespace microslip::contact {

struct PreloadResultants {
  double force = 0.0;           ///< F [N]
  double moment_about_p = 0.0;  ///< M_p [N m]
  double moment_about_r = 0.0;  ///< M_r [N m]
};

/// F over the area [Pa], n points.
/// @throws std::invalid_argument  the weights do not sum to a positive area.
[[nodiscard]] Eigen::VectorXd uniform_preload(const Eigen::VectorXd& weights, double force);

/// (1).
/// @param p, r     coordinates [m], n.   @param weights  [m²], n.
/// @throws std::invalid_argument  sizes differ, no area, or points on a line, which cannot carry the
///         moment about it.
[[nodiscard]] Eigen::VectorXd linear_preload(const Eigen::VectorXd& p, const Eigen::VectorXd& r,
                                             const Eigen::VectorXd& weights,
                                             const PreloadResultants& requested);

/// What a field amounts to, gaps counted as negative pressure.
[[nodiscard]] PreloadResultants resultants(const Eigen::VectorXd& p, const Eigen::VectorXd& r,
                                           const Eigen::VectorXd& weights,
                                           const Eigen::VectorXd& pressure);

/// ∬ max(n, 0) dA [N].
/// @throws std::invalid_argument  sizes differ or a value is not finite.
[[nodiscard]] double carried_force(const Eigen::VectorXd& pressure, const Eigen::VectorXd& weights);

/// `shape` times the factor s ≥ 0 of (2); it keeps its signs.
/// @param force  [N], ≥ 0.
/// @throws std::invalid_argument  sizes differ, a value is not finite, the force is negative, or ∬ shape dA is not
///         above 0 (beyond rounding): a patch that is more gap than contact; names both integrals.
[[nodiscard]] Eigen::VectorXd scaled_preload(const Eigen::VectorXd& shape,
                                             const Eigen::VectorXd& weights, double force);

/// (2). @param relative_tolerance  of |∬ max(n, 0) dA − force| against the force.
/// @throws std::invalid_argument  the field carries something else; names both numbers.
void require_total(const Eigen::VectorXd& pressure, const Eigen::VectorXd& weights, double force,
                   double relative_tolerance);

/// Pressure that stands for a gap [m] at each point: −k_v gap; gap 0 is contact without load.
[[nodiscard]] Eigen::VectorXd preload_of_gap(const Eigen::VectorXd& gap,
                                             const Eigen::VectorXd& normal_stiffness);

}  // namespace microslip::contact
