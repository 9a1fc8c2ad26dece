/// @file
/// The list of segments that every method reports, from the phases it found.
#pragma once

#include <vector>

#include "contact/contact_state.hpp"

namespace microslip::contact {

/// In [0, 2π).
[[nodiscard]] double wrapped_phase(double phase);

/// @param phases    in order of time; starts may lie beyond 2π, lengths sum to 2π.
/// @param shortest  phases shorter than this are joined to the one before [rad].
/// @return segments from the smallest start; neighbours differ, lengths sum to 2π.
[[nodiscard]] std::vector<CycleSegment> joined_segments(const std::vector<CycleSegment>& phases,
                                                        double shortest);

}  // namespace microslip::contact
