/// @file
/// The preload a meshed contact asks for, on its face alone:
/// what can be said and refused before a mode is solved.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "mesh/mesh.hpp"
#include "pipelines/description/scene_description.hpp"

namespace microslip::pipelines {

/// contact.preload_field scaled so that the points carry 1 N (contact/patch/preload_field.hpp);
/// uniform without one.
/// @param p, r  from the centroid of the patch [m], n.   @param weights  [m²], n.
/// @return [Pa], n.
/// @throws SceneError  the field is not finite, or its integral is not above 0: names its place.
[[nodiscard]] Eigen::VectorXd preload_field_of(const ContactDescription& contact,
                                               const Eigen::VectorXd& p, const Eigen::VectorXd& r,
                                               const Eigen::VectorXd& weights);

/// What each contact carries of a load that presses (contact/patch/patch_load.hpp), sum 1.
[[nodiscard]] std::vector<double> preload_shares(const mesh::Mesh& mesh,
                                                 const SceneDescription& scene);

/// Every preload of the scene against the face it presses.
/// @throws SceneError    as preload_field_of().
/// @throws RefusedError  contact.preload_moment that a preload of the list cannot balance on this
///         face.
void require_preload(const mesh::Mesh& mesh, const SceneDescription& scene);

/// A sentence on a preload field that is partly a gap; empty where it presses everywhere.
[[nodiscard]] std::string describe_preload(const mesh::Mesh& mesh, const SceneDescription& scene);

}  // namespace microslip::pipelines
