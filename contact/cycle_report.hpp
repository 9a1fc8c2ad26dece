/// @file
/// What the points of a patch did over one period, in shares of (area × period).
#pragma once

#include <vector>

#include "contact/contact_patch.hpp"
#include "contact/friction_cycle.hpp"
#include "contact/modal_force.hpp"

namespace microslip::contact {

/// Shares by the lengths of the segments; the largest coexistence of the three states by a sweep
/// over all transition angles, between which the area fractions do not change; slip work ∬∮μn|ds|dA.
/// Shares are 0 if all weights are.
/// @param motions  one per point.
[[nodiscard]] CycleReport cycle_report(const ContactPatch& patch,
                                       const std::vector<PointMotion>& motions);

}  // namespace microslip::contact
