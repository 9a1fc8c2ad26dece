/// @file
/// The stage optimum of a run: the best value of a number of the scene, its error, and how it moves with what is
/// uncertain.
#pragma once

#include "pipelines/run/run_options.hpp"
#include "pipelines/run/run_record.hpp"
#include "pipelines/run/solution.hpp"

namespace microslip::pipelines {

/// @param solution  of a scene with response.optimum.
void find_best_value(const Solution& solution, const RunOptions& options, RunRecord& record);

}  // namespace microslip::pipelines
