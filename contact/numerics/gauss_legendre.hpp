/// @file
/// Gauss–Legendre rules on [0, 1] of any order.
#pragma once

#include <Eigen/Core>

namespace microslip::contact {

struct LineRule {
  Eigen::VectorXd nodes;    ///< in (0, 1), ascending
  Eigen::VectorXd weights;  ///< > 0, sum 1
};

/// @param order  number of points n ≥ 1; polynomials of degree 2n − 1 are exact.
/// @throws std::invalid_argument  order < 1.
[[nodiscard]] LineRule gauss_legendre(int order);

}  // namespace microslip::contact
