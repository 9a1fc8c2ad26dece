/// @file
/// What the names of a mesh stand for: the command `surfaces`,
/// and what `init mesh FILE` chooses from.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "mesh/mesh.hpp"

namespace microslip::pipelines {

/// Lengths are those of the mesh.
struct MeshName {
  std::string name;
  enum class Kind { surface, node_set, point } kind = Kind::surface;
  Eigen::Index n_faces = 0;  ///< 0: it is no place where something can rub
  Eigen::Index n_nodes = 0;
  double area = 0.0;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< of the area, or the mean of the nodes
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< mean, outward; 0 without faces
  double flatness =
      0.0;  ///< largest distance from the mean plane over the diagonal of the bounding box
};

/// "surface", "node set", "point".
[[nodiscard]] std::string kind_name(MeshName::Kind kind);

/// Surfaces first, then sets of nodes. A name that is both stands twice.
[[nodiscard]] std::vector<MeshName> mesh_names(const mesh::Mesh& mesh);

/// The table of the command `surfaces`, with its head.
/// @param unit  metres per unit of the file, if it is known: lengths are in m then,
///              else those of the file.
[[nodiscard]] std::string describe_names(const mesh::Mesh& mesh, std::optional<double> unit);

}  // namespace microslip::pipelines
