/// @file
/// The plain sampled contact law of many points: elastic Coulomb friction with a return to the cone
/// at every instant and a one-sided normal spring, with its derivative along a direction.
///
///   n_i  = max(0, g_i),  g = n₀ + k_n v
///   F*   = F_{i−1} + k_t (U_i − U_{i−1});     F_i = F* if |F*| ≤ μ n_i, else μ n_i F*/|F*|
///   touch-down between i−1 and i: F* = k_t (1 − τ)(U_i − U_{i−1}),  τ = g_{i−1}/(g_{i−1} − g_i)
///
/// U has one component (friction along p) or two (p and r). The sliders start at s = 0 and go
/// through periods until they repeat: two periods for one direction, because the period map is a
/// clip and so idempotent; for two directions as many as it takes.
/// Errors are O(1/n_instants²) for one direction.
#pragma once

#include <Eigen/Core>

namespace microslip::truth {

struct ContactConstants {
  double tangential_stiffness = 1e11;  ///< [N/m³]
  double normal_stiffness = 1e11;      ///< [N/m³]
  double friction_coefficient = 0.4;
  double pressure = 0.0;  ///< n₀ [Pa]; negative: a gap of −n₀/k_n
};

/// Motions [m] or tractions [Pa] of all points over a period; each n_instants × n_points.
struct PointHistory {
  Eigen::MatrixXd u, v, w;  ///< along p, q, r; w empty without friction along r
};

/// Shares of the period in contact and in contact without slip, per point.
struct ContactShares {
  Eigen::VectorXd contact, stick;
};

struct TractionResult {
  PointHistory tractions;  ///< v: normal pressure ≥ 0
  ContactShares shares;
};

[[nodiscard]] TractionResult tractions(const ContactConstants& constants,
                                       const PointHistory& motion);

/// Derivative of the tractions at `motion` along `change`, through all that the sliders remember.
[[nodiscard]] PointHistory tangent(const ContactConstants& constants, const PointHistory& motion,
                                   const PointHistory& change);

}  // namespace microslip::truth
