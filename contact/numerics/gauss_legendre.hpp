/// @file
/// Gauss–Legendre rules on [0, 1] of any order, and the stretchings of [0, 1] that turn functions of
/// the square root of the distance to an end into smooth ones.
///
///   x = t²,   1 − (1−t)²,   3t² − 2t³        graded at 0, at 1, at both ends
///
/// A function that is a power series in √x becomes one in t: Gauss converges exponentially again.
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

/// Ends at which a rule is graded.
struct GradedEnds {
  bool begin = false;
  bool end = false;
};

/// `rule` through the stretching. Weights sum to 1 if the rule is exact for degree 2 (order ≥ 2).
[[nodiscard]] LineRule graded(const LineRule& rule, GradedEnds ends);

}  // namespace microslip::contact
