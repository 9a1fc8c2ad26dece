/// @file
/// The points of a scene in its mesh: coordinates become the node nearest to them.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "mesh/mesh.hpp"
#include "pipelines/description/scene_description.hpp"

namespace microslip::pipelines {

/// The node that stands for coordinates.
struct LocatedPoint {
  std::string name;
  std::string place;  ///< "file:line: key", for messages
  Eigen::Index node = 0;
  double distance = 0.0;      ///< from the coordinates to the node [m]
  double element_size = 0.0;  ///< longest edge or diagonal at that node [m]
};

/// @return  the points of the scene that have coordinates.
/// @throws SceneError  a point farther from the mesh than the mesh is long: not of this blade,
///         or in another unit.
[[nodiscard]] std::vector<LocatedPoint> locate_points(const mesh::Mesh& mesh,
                                                      const SceneDescription& scene);

/// Gives the mesh the points of the scene as node sets,
/// so that every name is looked up in one place.
/// @throws SceneError  as above; a name that the mesh has too; another name of what is not there.
void name_points(mesh::Mesh& mesh, const SceneDescription& scene);

}  // namespace microslip::pipelines
