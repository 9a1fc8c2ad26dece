/// @file
/// Where in a time step a contact state ends first.
///
/// Guards are sampled at five instants of the step. A guard that is negative at one of them ends
/// its state before; one that dips between two of them is followed to its minimum first. The
/// instant is then bracketed to rounding on the polynomial of the step, where guards are smooth.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "contact/transient_force.hpp"
#include "solver/time/time_segment.hpp"

namespace microslip::solver {

/// A guard is violated below minus this: rounding of a force that is the difference of larger terms
/// is a few 1e-16 of them, and a state that begins where the last one ended starts within it.
inline constexpr double guard_tolerance = 1e-13;

struct TimeEvent {
  double at = 0.0;                   ///< x of the segment, in [0, 1]
  std::vector<Eigen::Index> points;  ///< all points that change there, in order
};

[[nodiscard]] std::optional<TimeEvent> first_event(const contact::TransientForce& contact,
                                                   const TimeSegment& segment,
                                                   const contact::TransientMemory& memory,
                                                   const contact::GuardScale& scale);

/// Where the motion first meets a kink of the held force inside a segment, x in (0, 1); a kink that
/// a step begins on is left behind. Sampled as the guards are,
/// so that two crossings between samples are missed.
[[nodiscard]] std::optional<double> first_kink(const contact::TransientForce& contact,
                                               const TimeSegment& segment);

}  // namespace microslip::solver
