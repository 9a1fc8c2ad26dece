/// @file
/// Forces and outputs of a scene as columns over the mesh. On a surface a force is a uniform
/// traction: node i takes its share ∫ N_i dA of the area, and an output is the mean over the area,
/// ∫ u dA / area = Σ share_i u_i. A set of nodes that are those of whole faces is a surface,
/// whichever of the two a format names. A point or any other set has no area: equal shares.
#pragma once

#include <string>

#include <Eigen/Core>

#include "mesh/mesh.hpp"
#include "pipelines/description/scene_description.hpp"

namespace microslip::pipelines {

/// Whether a force at what `at` names is spread over an area.
[[nodiscard]] bool is_spread(const mesh::Mesh& mesh, const std::string& at);

/// Unit force along a direction on what `at` names, which is also the mean motion it works on:
/// 3 n_nodes [-], the shares sum to 1.
/// @throws mesh::MeshError  no such surface, point or set.
[[nodiscard]] Eigen::VectorXd unit_load(const mesh::Mesh& mesh, const std::string& at,
                                        const Eigen::Vector3d& direction);

/// Excitation F_s sin θ + F_c cos θ: 3 n_nodes × 2 [N], sine and cosine part.
[[nodiscard]] Eigen::MatrixX2d excitation_loads(const mesh::Mesh& mesh,
                                                const std::vector<ForceDescription>& forces);

}  // namespace microslip::pipelines
