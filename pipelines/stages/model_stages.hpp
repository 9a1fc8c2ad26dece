/// @file
/// The stages mesh, modes and contact of a run: what they give is kept as soon as it is there.
#pragma once

#include "pipelines/record/run_record.hpp"
#include "pipelines/stages/solution.hpp"

namespace microslip::pipelines {

/// mesh → modes; what an earlier run has finished is taken from there. nullptr:
/// a kind that gives its modes itself.
/// @param cores  above 1: what the modes are extrapolated from may be solved beside them.
[[nodiscard]] StructurePointer solved_structure(const SceneDescription& scene, int cores,
                                                RunRecord& record);

/// → contact: the arrays the response stage needs. What `auto` leaves out by their indicators is
/// taken out of the scene of the solution as well.
void add_model(Solution& solution, RunRecord& record);

}  // namespace microslip::pipelines
