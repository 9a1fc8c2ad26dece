/// @file
/// Whether a planar slider can rest for a whole period without separation, and where best.
///
/// A slider rests if it lies in the ellipses of all phases (theory section 9, full stick):
///
///   G(s) = max_θ g(θ, s) ≤ 0,    g = |K (x − s)| − r                                          (1)
///
/// G is convex, and its least value, found where two or three windows of the period balance, tells
/// rest from slip without marching: G* ≤ 0 rest, G* > 0 slip, however little. Windows are the
/// maxima of g over θ, located between the instants of the intervals. The minimum is found by
/// Newton's method for such maxima (a quadratic programme with the curvature of the windows that
/// balance), with windows of failed steps kept as tangents:
/// they bound a convex function from below.
///
/// With multipliers λ of the windows, Σ λ = 1, any slider s' obeys G(s') ≥ Σ λ g − |Σ λ ∇g| |s' −
/// s|: slip is proved by this bound, before the minimum is known to all digits.
///
/// Source: theory sections 4.2, 9; J. Nocedal, S. J. Wright, Numerical Optimization, section 18
/// (sequential quadratic programming).
#pragma once

#include <cstdint>
#include <vector>

#include "contact/plane/planar_intervals.hpp"
#include "contact/plane/planar_motion.hpp"

namespace microslip::contact {

/// What |K (x − s)| − r may be off by rounding, / F₀.
inline constexpr double rest_rounding = 2e-15;

struct RestPlace {
  enum class Answer : std::uint8_t {
    rests,     ///< the slider lies in every ellipse, well inside or at the minimum
    slips,     ///< no slider does
    undecided  ///< the search has not converged
  };
  Answer answer = Answer::undecided;
  Eigen::Vector2d slider = Eigen::Vector2d::Zero();  ///< of the least G seen, / L₀
  double excess = 0.0;                               ///< its G / F₀
  bool converged = false;                            ///< slider and excess are those of the minimum
};

/// @param intervals  of a period without separation.
/// @param slider     to begin from, / L₀.
[[nodiscard]] RestPlace best_rest(const PlanarMotion& motion,
                                  const std::vector<PlanarInterval>& intervals,
                                  const Eigen::Vector2d& slider);

}  // namespace microslip::contact
