/// @file
/// How long the stages of a run are expected to take: what `check` forecasts,
/// and what `run` says of the time left where nothing else tells.
#pragma once

#include <vector>

#include "pipelines/description/scene_description.hpp"
#include "pipelines/model/reduced_model.hpp"
#include "pipelines/response/run_results.hpp"

namespace microslip::pipelines {

/// Of meshes of elements twice and four times as large, which tell the error of the mesh, and their
/// modes. Processor seconds of one core, as all here.
[[nodiscard]] double coarser_meshes_seconds(double degrees_of_freedom,
                                            const SceneDescription& scene);

/// Modes that are solved for again with effects that are left out, to tell what those would change.
/// @param model  nullptr: not known, so that a curved face is not.
[[nodiscard]] double modes_again_seconds(double degrees_of_freedom, const SceneDescription& scene,
                                         const ReducedModel* model);

/// Of the mesh alone, before there is one; 0: not known.
[[nodiscard]] double mesh_seconds(const SceneDescription& scene);

/// Of the stage `curves`, by the clock of so many cores.
[[nodiscard]] double curves_seconds(const ReducedModel& model, const SceneDescription& scene,
                                    int jobs);

/// Of the stage `accuracy`, errors of curves.
/// @param curves  as they were solved: where they took long, with many harmonics, so do their
///                errors.
/// @param degrees_of_freedom  0 without a mesh.
[[nodiscard]] double accuracy_seconds(const ReducedModel& model, const SceneDescription& scene,
                                      const std::vector<CurveResult>& curves,
                                      double degrees_of_freedom, int jobs);

/// Of the stage `optimum`. @param curves  as above: where they took long, so does a search that
/// solves for some of them. @param bracket  whether its bracket is solved for.
[[nodiscard]] double optimum_seconds(const ReducedModel& model, const SceneDescription& scene,
                                     const std::vector<CurveResult>& curves, bool bracket);

}  // namespace microslip::pipelines
