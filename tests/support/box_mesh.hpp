/// @file
/// Structured meshes of a box for tests, in every element type, with the six sides as named surfaces
/// "x0", "x1", "y0", "y1", "z0", "z1" and the corner at the largest coordinates as node set "corner".
#pragma once

#include <array>
#include <functional>

#include <Eigen/Core>

#include "mesh/mesh.hpp"

namespace microslip::test {

struct BoxGrid {
  Eigen::Vector3d size{1.0, 1.0, 1.0};  ///< edge lengths [m], from the origin
  std::array<int, 3> cells{1, 1, 1};    ///< hexahedra per direction; each makes six tetrahedra
  /// Moves every node after the edge nodes were placed in the middle of straight edges: distorts
  /// elements, curves their edges where it is not linear. Empty: identity.
  std::function<Eigen::Vector3d(const Eigen::Vector3d&)> map;
};

[[nodiscard]] mesh::Mesh box_mesh(mesh::ElementType type, const BoxGrid& grid);

/// The same, with corner nodes moved by `map` and edge nodes in the middle of the moved corners:
/// distorted elements with straight edges.
[[nodiscard]] mesh::Mesh straight_box_mesh(mesh::ElementType type, const BoxGrid& grid);

}  // namespace microslip::test
