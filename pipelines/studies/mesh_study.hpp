/// @file
/// The command `mesh`.
#pragma once

#include "pipelines/description/scene_description.hpp"
#include "pipelines/record/run_options.hpp"

namespace microslip::pipelines {

/// `mesh`: geometry → mesh file.
int mesh_study(const SceneDescription& scene, const RunOptions& options);

}  // namespace microslip::pipelines
