/// @file
/// The command `campbell`.
#pragma once

#include "pipelines/description/scene_description.hpp"
#include "pipelines/record/run_options.hpp"
#include "pipelines/structure/campbell.hpp"

namespace microslip::pipelines {

/// `campbell`: natural frequencies over speed, tables and plot in campbell/.
int campbell_study(const SceneDescription& scene, const CampbellRequest& request,
                   const RunOptions& options);

}  // namespace microslip::pipelines
