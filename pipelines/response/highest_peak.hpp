/// @file
/// The point of a curve that its summary, its error and its maps are about.
#pragma once

#include "solver/response_curve.hpp"

namespace microslip::pipelines {

/// The highest solved peak; without one the largest point. nullptr: no points.
[[nodiscard]] const solver::ResponsePoint* highest_peak(const solver::ResponseCurve& curve);

/// The same where no other point is larger: beside a range that is narrow about a peak it may have
/// moved out. nullptr: it has, or none was solved for.
[[nodiscard]] const solver::ResponsePoint* peak_above_all(const solver::ResponseCurve& curve);

}  // namespace microslip::pipelines
