/// @file
/// The command `converge`.
#pragma once

#include "pipelines/run/run_options.hpp"
#include "pipelines/scene/scene_description.hpp"

namespace microslip::pipelines {

/// `converge`: every ladder of the discretisation, tables in converge/ and plots.
int converge_study(const SceneDescription& scene, const RunOptions& options);

}  // namespace microslip::pipelines
