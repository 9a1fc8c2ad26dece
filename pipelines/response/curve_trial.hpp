/// @file
/// What the curves of a scene take, measured by beginning them.
#pragma once

#include "pipelines/description/scene_description.hpp"
#include "pipelines/effects/curve_cost.hpp"
#include "pipelines/model/reduced_model.hpp"

namespace microslip::pipelines {

/// Curves of harmonic balance under a load are traced in turn, each for its share of a time. One
/// that comes to its end has taken what it takes; the rest of another is forecast by how far it has
/// come, weighed with what response_seconds() says. A search for other branches, a best value and,
/// of scenes without a mesh, errors are multiplied by what an evaluation of the contact took over
/// what it was said to take. Motions in time are not begun, nor are curves that cannot be solved
/// for, or whose first solution takes longer than the time: of those the forecast stands.
/// @param scene    with [response].
/// @param seconds  of processor time that the curves are traced, all together.
/// @return  [s] on this machine.
[[nodiscard]] ResponseSeconds tried_seconds(const ReducedModel& model,
                                            const SceneDescription& scene,
                                            const CurveEffects& effects, double seconds);

}  // namespace microslip::pipelines
