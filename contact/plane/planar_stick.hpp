/// @file
/// Where a resting slider of a planar point begins to move: the first phase at which
///
///   |K (x − s)| > r                                                                          (1)
///
/// is looked for cell by cell of the instants of an interval, on both sides of a minimum of the
/// force, at the maximum between two instants, and in halves of cells in which (1) comes close;
/// it is found to rounding.
///
/// Source: theory sections 3, 9.
#pragma once

#include <Eigen/Core>

#include "contact/plane/planar_intervals.hpp"
#include "contact/plane/planar_motion.hpp"

namespace microslip::contact {

/// What |K (x − s)| may exceed r by and still count as stuck: rounding of numbers of order one.
inline constexpr double stick_slack = 4e-15;

/// @param slider  at rest, / L₀.   @param from  instant in the interval from which it is stuck.
/// @return the end of the interval where it stays stuck.
[[nodiscard]] double end_of_stick(const PlanarMotion& motion, const PlanarInterval& interval,
                                  const Eigen::Vector2d& slider, const PlanarInstant& from);

}  // namespace microslip::contact
