/// @file
/// What `auto` takes out of a description: roughness and friction by slip speed that keys give, and
/// that the model of the scene says matter too little.
#pragma once

#include <string>
#include <vector>

#include "pipelines/description/scene_description.hpp"
#include "pipelines/effects/model_family.hpp"
#include "pipelines/model/reduced_model.hpp"
#include "pipelines/structure/solved_structure.hpp"

namespace microslip::pipelines {

/// Those whose indicators are below their limits (effect_table.hpp). None where linear limits are
/// all that is asked for, which have neither.
/// @param model  of the scene with them.
[[nodiscard]] std::vector<std::string> to_leave_out(const SceneDescription& scene,
                                                    const ReducedModel& model);

/// A scene as it is simulated, and its model.
struct SimulatedScene {
  SceneDescription scene;
  ReducedModel model;
};

/// Without to_leave_out(): with one set of effects for all curves.
/// @param model      of the scene as it is given.
/// @param structure  as of model_of().
/// @throws SceneError, RefusedError  as model_of().
[[nodiscard]] SimulatedScene simulated(const SceneDescription& scene, ReducedModel model,
                                       const SolvedStructure* structure);

}  // namespace microslip::pipelines
