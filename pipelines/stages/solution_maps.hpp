/// @file
/// The stage maps of a run.
#pragma once

#include "pipelines/record/run_record.hpp"
#include "pipelines/stages/solution.hpp"

namespace microslip::pipelines {

/// Maps of the curves, on as many contact points as a picture wants.
void draw_maps(const Solution& solution, int jobs, RunRecord& record);

}  // namespace microslip::pipelines
