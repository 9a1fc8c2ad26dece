/// @file
/// What a run with a budget of time begins with.
#pragma once

#include "pipelines/description/scene_description.hpp"

namespace microslip::pipelines {

/// Harmonics that are chosen to the accuracy asked for may take all of the time there is, and what
/// they are chosen from is a curve with one. With a budget of time the first curves are those that
/// every result can be had with: nine harmonics, which leave some per cent, where they take less
/// than four fifths of it, else one. What they lack is told, and refined in the time that is left.
/// @return  the scene as it is without a budget, where harmonics are given, or where linear limits
///          alone are asked for.
[[nodiscard]] SceneDescription first_settings(SceneDescription scene);

}  // namespace microslip::pipelines
