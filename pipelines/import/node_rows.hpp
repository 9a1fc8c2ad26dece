/// @file
/// Nodes of other codes in the mesh of a scene: by their places,
/// whatever numbers or order they have.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "mesh/mesh.hpp"

namespace microslip::pipelines {

/// Row of `nodes` for every node of the mesh: the nearest one within 1e-5 of the largest
/// coordinate.
/// @param nodes  n × 3 [m].  @param file  they are from, and the place in the scene that names it,
///               for messages.
/// @throws SceneError  a node of the mesh that has none: how many, where, the size of both.
[[nodiscard]] std::vector<Eigen::Index> rows_of_nodes(const mesh::Mesh& mesh,
                                                      const Eigen::MatrixX3d& nodes,
                                                      const std::filesystem::path& file,
                                                      const std::string& place_of_file);

/// Rows of nodes of the mesh with another row each that lies in the same place,
/// within the same distance.
[[nodiscard]] std::vector<std::array<Eigen::Index, 2>> rows_in_one_place(
    const mesh::Mesh& mesh, const Eigen::MatrixX3d& nodes, const std::vector<Eigen::Index>& rows);

}  // namespace microslip::pipelines
