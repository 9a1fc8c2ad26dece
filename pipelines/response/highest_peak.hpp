/// @file
/// The point of a curve that its summary, its error and its maps are about.
#pragma once

#include "solver/response_curve.hpp"

namespace microslip::pipelines {

/// The highest solved peak; without one the largest point. nullptr: no points.
[[nodiscard]] const solver::ResponsePoint* highest_peak(const solver::ResponseCurve& curve);

}  // namespace microslip::pipelines
