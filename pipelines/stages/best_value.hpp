/// @file
/// The stages maps and optimum of a run that searches for a best value: that value of a number of
/// the scene, its error, and how it moves with what is uncertain.
#pragma once

#include "pipelines/record/run_options.hpp"
#include "pipelines/record/run_record.hpp"
#include "pipelines/stages/solution.hpp"

namespace microslip::pipelines {

/// Maps, if the options ask for them, are drawn beside the search where there are cores and time is
/// not limited, within the stage optimum.
/// @param solution  of a scene with response.optimum.
void draw_maps_and_find_best_value(const Solution& solution, const RunOptions& options,
                                   RunRecord& record);

}  // namespace microslip::pipelines
