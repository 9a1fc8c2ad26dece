/// @file
/// How a preload is spread over a patch: the rest load of each point (theory sections 2, 12): n₀' ≥
/// 0 presses, n₀' < 0 is a gap of −n₀'/k_v. Values per point (an expression, a table) are scaled to
/// a total or checked against it. The total is the normal force that is carried at rest, n_ref =
/// max(n₀', 0) (theory section 2; as the loads of cells that have lifted off in section 12):
///
///   ∬ max(n, 0) dA = F                                                                         (1)
///
/// A gap pulls on nothing and does not count against it, as it would in ∬ n dA.
///
/// Integrals are sums over the points with their weights,
/// so that (1) holds to rounding on any rule.
#pragma once

#include <Eigen/Core>

namespace microslip::contact {

/// F over the area [Pa], n points.
/// @throws std::invalid_argument  the weights do not sum to a positive area.
[[nodiscard]] Eigen::VectorXd uniform_rest_load(const Eigen::VectorXd& weights, double force);

/// ∬ max(n, 0) dA [N].
/// @throws std::invalid_argument  sizes differ or a value is not finite.
[[nodiscard]] double carried_force(const Eigen::VectorXd& pressure, const Eigen::VectorXd& weights);

/// `shape` times the factor s ≥ 0 of (1); it keeps its signs.
/// @param force  [N], ≥ 0.
/// @throws std::invalid_argument  sizes differ, a value is not finite, the force is negative, or ∬
///         shape dA is not above 0 (beyond rounding): a patch that is more gap than contact;
///         names both integrals.
[[nodiscard]] Eigen::VectorXd scaled_rest_load(const Eigen::VectorXd& shape,
                                               const Eigen::VectorXd& weights, double force);

/// (1). @param relative_tolerance  of |∬ max(n, 0) dA − force| against the force.
/// @throws std::invalid_argument  the field carries something else; names both numbers.
void require_total(const Eigen::VectorXd& pressure, const Eigen::VectorXd& weights, double force,
                   double relative_tolerance);

}  // namespace microslip::contact
