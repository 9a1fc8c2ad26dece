/// @file
/// The command `mesh`.
#pragma once

#include "pipelines/run/run_options.hpp"
#include "pipelines/scene/scene_description.hpp"

namespace microslip::pipelines {

/// `mesh`: geometry → mesh file.
int mesh_study(const SceneDescription& scene, const RunOptions& options);

}  // namespace microslip::pipelines
