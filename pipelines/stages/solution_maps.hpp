/// @file
/// The stage maps of a run.
#pragma once

#include "pipelines/record/run_options.hpp"
#include "pipelines/record/run_record.hpp"
#include "pipelines/stages/solution.hpp"

namespace microslip::pipelines {

/// Whether there is anything to draw: maps that the scene names, and the motion at the peaks beside
/// them. A scene that names none asks for no picture of a solution.
[[nodiscard]] bool draws_maps(const SceneDescription& scene, const RunOptions& options);

/// Maps of the curves, on as many contact points as a picture wants.
void draw_maps(const Solution& solution, int jobs, RunRecord& record);

}  // namespace microslip::pipelines
