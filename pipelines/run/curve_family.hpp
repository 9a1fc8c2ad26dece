/// @file
/// The curves of a scene, each on whichever worker is free, and the maps on them.
#pragma once

#include <vector>

#include "pipelines/model/reduced_model.hpp"
#include "pipelines/response/run_results.hpp"
#include "pipelines/run/run_record.hpp"

namespace microslip::pipelines {

/// Traces every curve of the scene on `jobs` threads and keeps each as it is finished. The curves do
/// not know of each other: the numbers are bitwise those of one thread.
/// @throws InterruptedError  after an interrupt, with the finished curves kept.
[[nodiscard]] std::vector<CurveResult> trace_family(const ReducedModel& model,
                                                    const SceneDescription& scene, int jobs,
                                                    RunRecord& record);

/// Contact maps where the scene asks for them, and the motion of the blade at the peaks.
void draw_maps(const ReducedModel& model, const SceneDescription& scene,
               const std::vector<CurveResult>& curves, RunRecord& record);

/// Tells how far every curve can be trusted, unless the scene wants it not; their bars are set.
/// @param structure  of the scene; nullptr: a kind that gives its modes itself.
void tell_errors(const ReducedModel& model, const SceneDescription& scene,
                 const SolvedStructure* structure, int jobs, std::vector<CurveResult>& curves,
                 RunRecord& record);

}  // namespace microslip::pipelines
