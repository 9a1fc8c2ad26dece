/// @file
/// The square [−1, 1]² split along the zero lines of polynomials: equation (1) of fitted_rule.hpp for
/// one cell.
#pragma once

#include <vector>

#include "contact/numerics/chebyshev_surface.hpp"
#include "contact/force/fitted_rule.hpp"

namespace microslip::contact {

/// Points in the square; weights sum to 4.
struct SquareRule {
  std::vector<double> xi;
  std::vector<double> eta;
  std::vector<double> weights;
};

/// @param surfaces  one per guard; all of them, a line may ask for the sign of another.
/// @param crossing  guards that may vanish in the square.
[[nodiscard]] SquareRule height_rule(const std::vector<ChebyshevSurface>& surfaces,
                                     const std::vector<int>& crossing,
                                     const std::vector<GuardLine>& lines,
                                     const FittedRuleOptions& options);

}  // namespace microslip::contact
