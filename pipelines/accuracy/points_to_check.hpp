/// @file
/// Which solution points of a curve, beside its peaks, an effect that is left out is put back at.
/// Each takes an evaluation, so they are few. With the indicator I and the amplitude A, of those
/// where I is above its threshold: first the largest I, where motion is least like one without the
/// effect, then again and again the largest
///
///   I A d,     d the distance, along the curve, to the peaks and the points that are chosen
///
/// I A: what is left out beside the highest peak. The largest I alone often lies where the output
/// hardly moves, and says nothing of it then. Distances are counted in points, which are dense
/// where the response turns.
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "solver/response_curve.hpp"

namespace microslip::pipelines {

inline constexpr std::size_t most_points_to_check = 6;

/// @param indicator  of every point, n_points.
/// @return indices of points, at most so many. No peaks, which are solved for anyway, and no folds.
[[nodiscard]] std::vector<std::size_t> points_to_check(const solver::ResponseCurve& curve,
                                                       const Eigen::VectorXd& indicator,
                                                       double threshold);

}  // namespace microslip::pipelines
