/// @file
/// The point of a curve that its summary, its error and its maps are about, and whether it is known
/// what chosen harmonics leave out there.
#pragma once

#include "solver/response_curve.hpp"

namespace microslip::pipelines {

/// The highest solved peak; without one the largest point. nullptr: no points.
[[nodiscard]] const solver::ResponsePoint* highest_peak(const solver::ResponseCurve& curve);

/// The same where no other point is larger: beside a range that is narrow about a peak it may have
/// moved out. nullptr: it has, or none was solved for.
[[nodiscard]] const solver::ResponsePoint* peak_above_all(const solver::ResponseCurve& curve);

/// Of the solved peaks the one nearest to a frequency [rad/s]. nullptr: there is none.
[[nodiscard]] const solver::ResponsePoint* nearest_peak(const solver::ResponseCurve& curve,
                                                        double frequency);

/// The choice of its harmonics did not come to its end.
[[nodiscard]] bool is_unsettled(const solver::ResponseCurve& curve);

/// Whether what chosen harmonics leave out at a point is known: an unsettled choice tells it where
/// it was asked and is so small that the peak keeps its frequency.
[[nodiscard]] bool is_left_out_known(const solver::ResponseCurve& curve, double left_out);

}  // namespace microslip::pipelines
