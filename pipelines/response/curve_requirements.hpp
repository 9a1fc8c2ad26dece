/// @file
/// What can be told of the curves of a scene before the first is traced.
#pragma once

#include <Eigen/Core>

#include "pipelines/description/scene_description.hpp"
#include "pipelines/model/reduced_model.hpp"

namespace microslip::pipelines {

/// @throws SceneError    no [response], or one that speaks of a contact the scene does not have.
/// @throws RefusedError  a preload of the list that cannot carry the moments of the scene.
void require_response(const SceneDescription& scene);

/// @throws RefusedError  a rigid-body mode is held neither by supports nor by the contact.
void require_held(const ReducedModel& model, const SceneDescription& scene);

/// Natural frequencies with every contact point stuck [Hz], ascending, as many as the model has.
[[nodiscard]] Eigen::VectorXd stuck_frequencies(const ReducedModel& model);

/// Moments beside the preload can be balanced under all loads the scene asks for.
/// @throws RefusedError  they cannot; the message names the force they need.
void require_loads(const ReducedModel& model, const SceneDescription& scene);

/// What can be told of the curves before the first is traced: moments beside every preload are
/// balanced, fixed steps in time are enough.
/// @throws RefusedError, SceneError  as require_loads() and require_steps().
void require_curves(const ReducedModel& model, const SceneDescription& scene);

}  // namespace microslip::pipelines
