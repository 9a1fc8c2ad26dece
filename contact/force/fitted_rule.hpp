/// @file
/// Quadrature fitted to lines on a patch where the integrand is not smooth, such as the onset of slip
/// (theory section 13): cells crossed by a line are split along it, so that every piece sees a smooth
/// function and Gauss converges exponentially instead of like a kink.
///
/// The lines are zeros of guards, functions that are smooth themselves. Inside a cell (ξ, η) ∈ [−1, 1]²
/// each guard is sampled into a Chebyshev surface, of degree 4, 8, 16 or 32 as it needs; a cell in which a
/// guard that may vanish is not resolved by then is quartered. On the surfaces,
///
///   ∬ f dξ dη = Σ_intervals ∫ dξ Σ_pieces ∫_{η_k(ξ)}^{η_k+1(ξ)} f dη                                (1)
///
/// with η_k all zeros of the guards on the line ξ = const, pairs included, and intervals that end where
/// the pattern of zeros changes: a line leaves the cell, turns back (∂g/∂η = 0: closed loops, tangents),
/// two lines cross. ξ and η change roles where that makes fewer intervals. At such ends the inner
/// integral goes like a square root, so the outer rule is graded there; next to a line the inner rule is
/// graded on the side where the integrand is a function of the root of the guard. An interval is halved
/// until order-point Gauss integrates the lines to `line_tolerance`.
///
/// Source of (1): height functions as in Saye, SIAM J. Sci. Comput. 37 (2015) A993–A1019; here turning
/// points are resolved by grading instead of by monotone boxes.
#pragma once

#include <functional>
#include <vector>

#include "contact/patch/patch_quadrature.hpp"

namespace microslip::contact {

/// What is known about the zero line of one guard.
struct GuardLine {
  /// The integrand depends on √guard where the guard is positive and is smooth where it is negative.
  bool is_graded = false;
  /// The line counts only where this other guard has sign `domain_sign`; −1: everywhere.
  int domain = -1;
  int domain_sign = -1;
};

/// Functions of position whose zeros are the lines.
struct Guards {
  /// (p, r) [m], n each → n × lines.size().
  std::function<Eigen::MatrixXd(const Eigen::VectorXd& p, const Eigen::VectorXd& r)> values;
  std::vector<GuardLine> lines;
};

struct FittedRuleOptions {
  int order = 8;  ///< Gauss points per direction and piece, ≥ 1
  double line_tolerance =
      1e-10;          ///< error of the area on one side of a line, per area of its cell; > 0
  int max_depth = 6;  ///< quarterings of a cell where guards are not smooth, ≥ 0
};

/// @throws std::invalid_argument  an option out of range, guards of another size or not finite (names the
///         place); otherwise as patch_cells().
/// @note Without a zero of any guard this is gauss_rule(cells, order).
[[nodiscard]] PatchRule fitted_rule(const PatchCells& cells, const Guards& guards,
                                    const FittedRuleOptions& options);

}  // namespace microslip::contact
