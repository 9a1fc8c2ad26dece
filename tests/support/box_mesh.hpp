/// @file
/// Structured meshes of a box for tests, in every element type, with the six sides as named
/// surfaces "x0", "x1", "y0", "y1", "z0", "z1" and the corner at the largest coordinates as node
/// set "corner".
#pragma once

#include <array>
#include <functional>

#include <Eigen/Core>

#include "mesh/mesh.hpp"

namespace microslip::test {

struct BoxGrid {
  Eigen::Vector3d size{1.0, 1.0, 1.0};  ///< edge lengths [m], from the origin
  /// Hexahedra per direction; each makes six tetrahedra, two wedges (triangles on z0 and z1) or six
  /// pyramids around its middle.
  std::array<int, 3> cells{1, 1, 1};
  /// Moves every node after the edge nodes were placed in the middle of straight edges: distorts
  /// elements, curves their edges where it is not linear. Empty: identity.
  std::function<Eigen::Vector3d(const Eigen::Vector3d&)> map;
};

/// A map: moves inner and outer nodes of a box of side 1 by up to a sixth of a cell.
[[nodiscard]] Eigen::Vector3d distorted(const Eigen::Vector3d& x);

[[nodiscard]] mesh::Mesh box_mesh(mesh::ElementType type, const BoxGrid& grid);

/// The same, with corner nodes moved by `map` and edge nodes in the middle of the moved corners:
/// distorted elements with straight edges.
[[nodiscard]] mesh::Mesh straight_box_mesh(mesh::ElementType type, const BoxGrid& grid);

/// Cells along x in turn: hexahedra, wedges, a layer of pyramids and tetrahedra, tetrahedra, and
/// back. Four make a conforming mesh of all solids; sides y and z then have triangles beside
/// quadrilaterals.
/// @param order  1 or 2.
[[nodiscard]] mesh::Mesh mixed_box_mesh(int order, const BoxGrid& grid);
[[nodiscard]] mesh::Mesh straight_mixed_box_mesh(int order, const BoxGrid& grid);

}  // namespace microslip::test
