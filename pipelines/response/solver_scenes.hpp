/// @file
/// Reduced model under a load → what the solver takes: scenes and the options of a curve.
#pragma once

#include <Eigen/Core>

#include "pipelines/description/scene_description.hpp"
#include "pipelines/model/reduced_model.hpp"
#include "solver/continuation.hpp"
#include "solver/scene.hpp"

namespace microslip::pipelines {

/// A model under a load (point_parameters.hpp) as the solver takes it.
/// Modes and excitation of the model are copied.
[[nodiscard]] solver::Scene solver_scene(const ReducedModel& model, double load);

/// With the contact in time where that judges stability (solver/stability/stability.hpp).
[[nodiscard]] solver::Scene balanced_scene(const ReducedModel& model, double load,
                                           const solver::ContinuationOptions& options);

/// The options with the scene in which a search beside the curve tries its starts, where forces are
/// located in a plane: sampled in time, which is a tenth as dear.
[[nodiscard]] solver::ContinuationOptions with_search_scene(solver::ContinuationOptions options,
                                                            const ReducedModel& model, double load);

/// For the free and the stuck limit, which know no preload: no moment tilts, rough surfaces are in
/// full contact.
[[nodiscard]] solver::Scene limit_scene(ReducedModel model);

/// How much slower attachment shapes move than they do, a factor for each mode
/// (slow_attachment.hpp).
[[nodiscard]] Eigen::VectorXd slowing_of(const ReducedModel& model,
                                         const ResponseDescription& response);

/// To be integrated in time: explicit steps need not follow attachment shapes.
[[nodiscard]] solver::Scene integrated_scene(const ReducedModel& model,
                                             const ResponseDescription& response, double load);

/// @param model  whose contact says how exactly its forces can be balanced.
[[nodiscard]] solver::ContinuationOptions continuation_options(const SceneDescription& scene,
                                                               const ReducedModel& model);

}  // namespace microslip::pipelines
