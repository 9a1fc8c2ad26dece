/// @file
/// What a planar orbit was at any phase: states, forces, slider;
/// and its segments for maps and tables.
#pragma once

#include <vector>

#include "contact/plane/planar_orbit.hpp"
#include "contact/point/point_method.hpp"

namespace microslip::contact {

/// Segments from the smallest start; neighbours differ, lengths sum to 2π.
[[nodiscard]] std::vector<CycleSegment> planar_segments(const PlanarOrbit& orbit);

/// @param phase  θ [rad], any. Within slip the step that covers θ is solved again up to θ.
[[nodiscard]] PointInstant planar_instant(const PlanarMotion& motion, const PlanarOrbit& orbit,
                                          double phase);

}  // namespace microslip::contact
