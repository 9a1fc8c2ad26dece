/// @file
/// Slip of a planar slider over one step of time by collocation (Radau IIA, five stages).
///
/// While the point slips the slider lies on the edge of its ellipse and moves along the friction
/// force:
///
///   s = x − r C e(α),   s' ∥ e(α),   e = (cos α, sin α),   C = K⁻¹                          (1)
///
/// A polynomial of degree five through s(t₀) satisfies (1) at the five nodes c_i of Radau:
///
///   e_⊥(α_i) · Σ_j D_ij s_j = 0,   s_j = x_j − r_j C e(α_j),   j = 0 … 5                     (2)
///
/// with the angles α_i as unknowns. (2) needs no derivative of r and stays regular where r = 0, at
/// touch-down and lift-off; with a single stage it is the implicit return f = (I + λK)⁻¹ f* of
/// theory section 9. Order nine at the end of a step and for integrals over it; the stiff limit
/// (large amplitude, small r) is damped, since the last node is the end of the step.
///
/// The slip rate ρ = e·s' follows from x', r' and α alone, by eliminating α' from (1):
///
///   d = x' − (r C)' e,   ρ = e·d − (e·C e_⊥ / e_⊥·C e_⊥) e_⊥·d                                (3)
///
/// Source: theory section 9 (equations); E. Hairer, G. Wanner, Solving Ordinary Differential
/// Equations II, sections IV.5 and VII.4 (Radau IIA for index 2).
#pragma once

#include <array>

#include <Eigen/Core>
#include "contact/numerics/stage_factor.hpp"
#include "contact/plane/planar_motion.hpp"

namespace microslip::contact {

inline constexpr int n_stages = 5;

/// Constants of the collocation on [0, 1].
struct RadauNodes {
  std::array<double, n_stages> node{};    ///< c_i, the last is 1
  std::array<double, n_stages> weight{};  ///< of ∫₀¹
  Eigen::Matrix<double, n_stages, n_stages + 1>
      derivative;                                 ///< D: at c_i from values at 0, c_1 … c_5
  Eigen::Matrix<double, 1, n_stages + 1> top;     ///< share of the highest Legendre polynomial
  Eigen::Matrix<double, 1, n_stages> tail;        ///< the same from the values at c_1 … c_5 alone
  Eigen::Matrix<double, 1, n_stages> below_tail;  ///< and of the polynomial below it
};
[[nodiscard]] const RadauNodes& radau_nodes();

/// The ellipse |K (x − s)| ≤ r of one instant: returns K (x − s) for the slider after the return
/// from the trial force, (I + λK)⁻¹ f* with the smallest λ ≥ 0 that obeys it.
[[nodiscard]] Eigen::Vector2d returned_force(const Eigen::Vector2d& trial,
                                             const Eigen::Vector2d& stiffness, double radius);

/// (3), in units of L₀.
[[nodiscard]] double slip_rate(const PlanarInstant& now, const Eigen::Vector2d& direction);

/// One step; plain data, complete after solve_slip().
struct SlipStep {
  double begin = 0.0;
  double length = 0.0;
  Eigen::Vector2d slider = Eigen::Vector2d::Zero();  ///< s at begin, / L₀
  std::array<PlanarInstant, n_stages> instant;
  Eigen::Matrix<double, 2, n_stages> direction;  ///< e(α_i)
  Eigen::Matrix<double, 2, n_stages> stage;      ///< s_i
  Eigen::Matrix<double, 2, n_stages> travel;     ///< length · s'(c_i), along e
  StageFactor<n_stages> factor;                  ///< of ∂(2)/∂α
  double top_term = 0.0;                         ///< size of the highest polynomial in f / F₀
  /// What a rule of order nine leaves of a coefficient of friction whose polynomials go on falling
  /// as the last two, in f / F₀: much where a step ends in a layer of the rate.
  /// 0 for a constant coefficient.
  double rest = 0.0;

  [[nodiscard]] Eigen::Vector2d end_slider() const { return stage.col(n_stages - 1); }
  [[nodiscard]] double end() const { return begin + length; }
  /// ρ at a node.
  [[nodiscard]] double rate(int i) const {
    return slip_rate(instant[static_cast<std::size_t>(i)], direction.col(i));
  }
  /// The polynomial at begin + x · length, x in [0, 1].
  [[nodiscard]] Eigen::Vector2d slider_at(double x) const;
  /// The polynomial through the directions at the nodes, of any length.
  [[nodiscard]] Eigen::Vector2d direction_at(double x) const;
};

/// Solves (2) by Newton's method, started from the step before, or else from successive returns.
/// @param end_nudge  side of a kink for the derivatives of the law at the end of the step, ≤ 0.
/// @param before     step that ended where this one begins, if there is one: saves iterations.
/// @return whether it converged; if not, `step` holds the successive returns,
///         a solution of first order.
[[nodiscard]] bool solve_slip(const PlanarMotion& motion, double end_nudge, SlipStep& step,
                              const SlipStep* before = nullptr);

}  // namespace microslip::contact
