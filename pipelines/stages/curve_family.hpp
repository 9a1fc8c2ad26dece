/// @file
/// The curves of a scene, each on whichever worker is free, and the maps on them.
#pragma once

#include <vector>

#include "pipelines/description/curve_request.hpp"
#include "pipelines/model/reduced_model.hpp"
#include "pipelines/record/run_record.hpp"
#include "pipelines/response/run_results.hpp"

namespace microslip::pipelines {

/// Traces every curve of the scene on `jobs` threads and keeps each as it is finished. The curves
/// do not know of each other: the numbers are bitwise those of one thread.
/// @throws InterruptedError  after an interrupt, with the finished curves kept.
[[nodiscard]] std::vector<CurveResult> trace_family(const ReducedModel& model,
                                                    const SceneDescription& scene, int jobs,
                                                    RunRecord& record);

/// Some of them, of which the run's record is told nothing but the progress.
/// @param near  curves of a poorer model with the same modes, one per request,
///              near which they begin; or none.
/// @return one per request, cut short where the time is.
[[nodiscard]] std::vector<CurveResult> trace_again(
    const ReducedModel& model, const SceneDescription& scene,
    const std::vector<CurveRequest>& requests,
    const std::vector<const solver::ResponseCurve*>& near, int jobs, Progress& progress);

/// Contact maps where the scene asks for them, and the motion of the blade at the peaks; those of
/// `jobs` curves side by side.
void draw_maps(const ReducedModel& model, const SceneDescription& scene,
               const std::vector<CurveResult>& curves, int jobs, RunRecord& record);

/// How far every curve can be trusted; their bars are set.
/// @param structure  of the scene; nullptr: a kind that gives its modes itself.
/// @return one per curve; none where the scene wants it not.
[[nodiscard]] std::vector<CurveBudget> budgets_of(const ReducedModel& model,
                                                  const SceneDescription& scene,
                                                  const SolvedStructure* structure, int jobs,
                                                  std::vector<CurveResult>& curves,
                                                  Progress& progress);

}  // namespace microslip::pipelines
