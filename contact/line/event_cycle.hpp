/// @file
/// The steady cycle of many harmonics in full, given its phases: segments, work of friction, slip,
/// and what the point does at any instant (theory sections 7, 8).
#pragma once

#include <vector>

#include "contact/line/event_phases.hpp"
#include "contact/point/point_method.hpp"

namespace microslip::contact {

/// States in order of time from the smallest start; neighbours differ, lengths sum to 2π. Phases as
/// short as the rounding of their angles are joined to the one before. Offsets in Pa.
[[nodiscard]] std::vector<CycleSegment> event_segments(const PointParameters& point,
                                                       const EventPhases& phases);

/// The segment that holds at a phase. @param segments  as of event_segments().
/// @param phase any [rad].
[[nodiscard]] const CycleSegment& segment_at(const std::vector<CycleSegment>& segments,
                                             double phase);

struct EventWork {
  double normal_slip = 0.0;    ///< ∮ n |ds| [Pa·m]
  double slip_distance = 0.0;  ///< ∮ |ds| in contact [m]
};

/// Integrals of n |ds|, k_u |ds/dθ| = |dw/dθ|, over the slip phases by Gauss–Legendre quadrature on
/// pieces so short that it is exact to rounding; nothing cancels, nothing of it comes from the
/// Fourier coefficients. Zero where k_u = 0.
[[nodiscard]] EventWork event_work(const PointParameters& point, const EventGuards& guards,
                                   const EventPhases& phases);

/// @param motion  the one of the guards.
[[nodiscard]] PointInstant event_instant(const PointParameters& point, const Harmonics& motion,
                                         const CycleSegment& segment, double phase);

}  // namespace microslip::contact
