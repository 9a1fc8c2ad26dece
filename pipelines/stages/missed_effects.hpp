/// @file
/// Effects that `auto` has left out and that turn out to matter: simulated after all.
#pragma once

#include "pipelines/record/run_record.hpp"
#include "pipelines/stages/solution.hpp"

namespace microslip::pipelines {

/// Where the error budgets say that an effect left to the program changes a highest peak by more
/// than the tolerance (2 % without one), all curves are solved again with it, and take the place of
/// the others, in the solution and in the record. Each effect is put back once at most. Where that
/// is not done, time over or a curve incomplete, a warning says so and the objection to leaving it
/// out stays.
/// @return whether nothing that matters is left out now.
/// @throws InterruptedError
bool put_back_missed_effects(Solution& solution, int jobs, RunRecord& record);

}  // namespace microslip::pipelines
