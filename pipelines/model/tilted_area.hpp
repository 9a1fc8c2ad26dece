/// @file
/// Moments beside the preload (contact/patch/patch_load.hpp): what a scene alone says about them.
#pragma once

#include "pipelines/description/scene_description.hpp"

namespace microslip::pipelines {

/// Moments turn the contact under every preload of a scene, and a gap cannot carry them: refuses
/// these before anything is solved.
/// @throws RefusedError  names the preload of the list, and the key that gives the moments.
void require_pressing_loads(const SceneDescription& scene);

}  // namespace microslip::pipelines
