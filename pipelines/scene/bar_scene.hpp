/// @file
/// Scene kind `bar`: a uniform bar on a spring, driven at its free right end, that rubs along its
/// length under a normal load constant in time (paper A, section 4.1).
///
/// Contact points lie at the middles of equal cells, weight = their length; p = x. Output:
/// displacement of the right end.
#pragma once

#include "pipelines/sections/modes_section.hpp"

namespace microslip::pipelines {

/// @return modes by bar_modes(), points with stiffness per length [N/m²] and load [N/m] in the
///         places of stiffness [N/m³] and pressure [Pa], weights [m].
///         The load of a curve is a scale.
/// @throws SceneError    a bad key; a load that is no formula, not finite or negative.
/// @throws RefusedError  residual flexibility that makes the contact stiffness not positive, or a
///         free bar whose rigid-body mode is left out.
[[nodiscard]] ModalModel read_bar(const LeanSections& sections);

}  // namespace microslip::pipelines
