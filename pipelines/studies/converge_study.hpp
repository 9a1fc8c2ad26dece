/// @file
/// The command `converge`.
#pragma once

#include "pipelines/description/scene_description.hpp"
#include "pipelines/record/run_options.hpp"

namespace microslip::pipelines {

/// `converge`: every ladder of the discretisation, tables in converge/ and plots.
int converge_study(const SceneDescription& scene, const RunOptions& options);

}  // namespace microslip::pipelines
