/// @file
/// Contact data nobody knows well, multiplied: friction coefficient and local contact stiffness.
/// What is known stays as it is: the residual flexibility of the bodies, in series with the local
/// stiffness (theory section 14), and gaps, which are distances:
/// a negative preload −k_v·gap grows with k_v.
#pragma once

#include <optional>
#include <string>

#include "pipelines/description/scene_description.hpp"
#include "pipelines/model/reduced_model.hpp"

namespace microslip::pipelines {

/// Where a scene holds its local contact stiffness.
enum class StiffnessPlace {
  none,   ///< nowhere: no contact, or a rigid one
  keys,   ///< contact.*_stiffness, others are in series with it: the model is reduced anew
  points  ///< in the points themselves
};

[[nodiscard]] StiffnessPlace stiffness_place(const SceneDescription& scene);

/// The scene with contact.normal_stiffness and contact.tangential_stiffness times a factor, as far
/// as they are numbers. StiffnessPlace::keys only.
/// @throws SceneError, RefusedError  the kind cannot take it.
[[nodiscard]] SceneDescription with_stiffness_keys(const SceneDescription& scene, double factor);

/// The same of the points themselves. @param load  of the curve, as of point_parameters().
[[nodiscard]] ReducedModel with_point_stiffness(ReducedModel model, double factor, double load);

[[nodiscard]] ReducedModel with_friction(ReducedModel model, double factor);

/// The load that leaves the gap it stands for as it is; loads that press stay.
/// @param from  the model the load is given for. @param to  the same with another stiffness.
[[nodiscard]] double with_same_gap(double load, const ReducedModel& from, const ReducedModel& to);

/// Why friction, or local stiffness, is no number that can be multiplied; empty: it is.
[[nodiscard]] std::string no_friction_factor(const ReducedModel& model);
[[nodiscard]] std::string no_stiffness_factor(const ReducedModel& model,
                                              const SceneDescription& scene);

}  // namespace microslip::pipelines
