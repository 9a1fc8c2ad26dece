/// @file
/// Curves whose forces are sampled in time, with as many instants as their accuracy asks for. Half
/// or twice as many tell what a force errs by at solved points; where that is more than the
/// tolerance of the model, the curve is traced again with more of them; with every event located
/// where that is as cheap, and where the errors lead the walk along a line or of few points.
#pragma once

#include "pipelines/description/scene_description.hpp"
#include "pipelines/model/reduced_model.hpp"
#include "solver/continuation.hpp"

namespace microslip::pipelines {

/// The curve under a load, or the points at the only frequency.
/// @param model  whose contact is sampled (contact::is_sampled).
/// @return its log begins with what was done: more_instants, once for every doubling,
///         located_events. Where most instants err by more than asked the message says by how much.
[[nodiscard]] solver::ResponseCurve sampled_curve(const ReducedModel& model,
                                                  const SceneDescription& scene, double load,
                                                  const solver::ContinuationOptions& options,
                                                  const solver::PointObserver& observe);

/// The model a curve was solved with: its instants, or events located.
[[nodiscard]] ReducedModel model_of(ReducedModel model, const solver::ResponseCurve& curve);

}  // namespace microslip::pipelines
