/// @file
/// A patch as one contact point: what is left of an area that may carry no moments.
#pragma once

#include "contact/patch.hpp"

namespace microslip::pipelines {

/// The point in the middle of all points of a patch, weighted by their areas: it has the whole
/// area, and of motion, stiffness, friction and pressure the means. There are no vertices.
[[nodiscard]] contact::Patch at_middle_point(contact::Patch patch);

}  // namespace microslip::pipelines
