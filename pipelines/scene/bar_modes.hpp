/// @file
/// Longitudinal modes of a uniform bar held by a spring at its left end, in closed form.
///
///   EA u″ = ρA ü,    EA u′(0) = β u(0),    u′(L) = 0
///   φ_n = c_n cos(z_n (1 − x/L)),    z_n tan z_n = κ = βL/(EA)
///   z_n in (kπ, kπ + π/2),    k = n − 1
///   ω_n = (z_n/L) √(E/ρ),    c_n² = 2/(ρAL [1 + sin(2z_n)/(2z_n)])
///
/// Limits: β → ∞ is clamped (z = π/2, 3π/2, …); β = 0 is free, with a rigid-body mode z = 0,
/// φ = 1/√(ρAL).
///
/// Flexibility of the modes left out, for uniform traction along the bar (theory section 14):
///
///   c(x) = L/β + (xL − x²/2)/(EA) − Σ_n φ_n(x) ∫φ_n dx / ω_n²        over the modes kept
///
/// Source: Cigeroglu, An & Menq, Nonlinear Dyn. 50 (2007), section 4.1, for the equation; the modes
/// are elementary.
#pragma once

#include <vector>

#include <Eigen/Core>

namespace microslip::pipelines {

struct Bar {
  double youngs_modulus = 0.0;  ///< E [Pa], > 0
  double area = 0.0;            ///< A [m²], > 0
  double density = 0.0;         ///< ρ [kg/m³], > 0
  double length = 0.0;          ///< L [m], > 0
  double end_stiffness = 0.0;   ///< β [N/m], ≥ 0; infinity: clamped
};

/// Some modes of a bar, mass-normalised.
struct BarModes {
  Eigen::VectorXd root;       ///< z_n
  Eigen::VectorXd frequency;  ///< ω_n [rad/s]
  Eigen::VectorXd amplitude;  ///< c_n [1/√kg], the value at the right end
};

/// z_n of mode `number` ≥ 1: bracketed in its half-period and halved down to rounding.
/// @param kappa  βL/(EA), ≥ 0; infinity: clamped.
/// @note bar_root(infinity, 1) is π/2; bar_root(0, 1) is 0.
[[nodiscard]] double bar_root(double kappa, int number);

/// @param numbers  of the modes wanted, each ≥ 1.
[[nodiscard]] BarModes bar_modes(const Bar& bar, const std::vector<int>& numbers);

/// φ_n(x). @param x  positions [m], n_points.  @return n_points × n_modes [1/√kg].
[[nodiscard]] Eigen::MatrixXd bar_shapes(const Bar& bar, const BarModes& modes,
                                         const Eigen::VectorXd& x);

/// c(x) [m²/N] of the modes that are not in `modes`. It changes sign along the bar, as they do.
/// @throws std::invalid_argument  a free bar without its rigid-body mode: what is left out would
///         not be flexible. With it c is zero: uniform traction moves a free bar as a rigid body.
[[nodiscard]] Eigen::VectorXd bar_residual_flexibility(const Bar& bar, const BarModes& modes,
                                                       const Eigen::VectorXd& x);

}  // namespace microslip::pipelines
