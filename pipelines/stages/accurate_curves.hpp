/// @file
/// Curves as exact as a scene asks for: solved, told how far they can be trusted, and solved again
/// with what contributes most refined, until the bar of every peak is below the tolerance or the
/// time is over.
#pragma once

#include "pipelines/record/run_record.hpp"
#include "pipelines/stages/solution.hpp"

namespace microslip::pipelines {

/// What mesh and modes have taken, those on larger elements too, out of what the eigensolver has.
/// On a slow or busy machine they are as dear beside the curves, whose seconds are measured.
/// Of modes from an earlier run, which do not tell, by their size [s].
[[nodiscard]] double seconds_of_structure(const StructureModes& modes);

/// Refines a solution that is kept in the record, where the scene asks for a tolerance; a finer one
/// that was solved in time takes its place, there and in the record. Effects that turn out to
/// matter on it are put back. Within a budget of time a round is begun only where maps and best
/// value have theirs as well.
/// @param options  what follows, and how many cores there are.
/// @throws as model_of(), solved_structure().
void refine_to_tolerance(Solution& solution, const RunOptions& options, RunRecord& record);

}  // namespace microslip::pipelines
