/// @file
/// Pressure of points that a force and moments press together: two stiff bodies tilt against each other
/// until the points, which cannot pull, carry the load (theory section 12, "Preload").
#pragma once

#include <Eigen/Core>

#include "pipelines/model/reduced_model.hpp"
#include "pipelines/scene/scene_description.hpp"

namespace microslip::pipelines {

/// Pressures at rest of the points of an area [Pa], in order; rough surfaces and bodies in series with
/// them included. Points that lift off have a gap: negative, −k_v times the opening. Where no point has
/// normal stiffness (constant loads) the load spreads as over an elastic foundation that is the same
/// everywhere.
/// @param load         of the curve [N]; the area has its share of it.
/// @param on_vertices  at the vertices of the cells instead, all of them: meshes have one area.
/// @throws RefusedError  no equilibrium; the message says why and which force would do. Stiffness here and
///         none there.
[[nodiscard]] Eigen::VectorXd tilted_pressures(const ReducedModel& model, const TiltedArea& area,
                                               double load, bool on_vertices);

/// Moments turn the contact under every preload of a scene, and a gap cannot carry them: refuses these before
/// anything is solved.
/// @throws RefusedError  names the preload of the list, and the key that gives the moments.
void require_pressing_loads(const SceneDescription& scene);

}  // namespace microslip::pipelines
