/// @file
/// How well shaped elements are, and warnings about the worst: slivers are valid, but spoil the
/// condition of the stiffness matrix and the accuracy around them.
///
/// At each corner with edges e₁, e₂, e₃ (of a pyramid: at its base):
///   dihedral angle at e₁   α = atan2(|e₁| det(e₁, e₂, e₃), (e₁ × e₂)·(e₁ × e₃))           (1)
///   height over (e₁, e₂)   h = det(e₁, e₂, e₃) / |e₁ × e₂|                               (2)
///   aspect ratio           longest edge / smallest height    (cube: 1, regular tetrahedron: 1.22)
/// Corners only: what edge nodes do to the Jacobian is judged by mesh_quality.hpp.
///
/// Source: Shewchuk, What is a good linear element?, 11th Int. Meshing Roundtable (2002),
/// sections 2–3.
#pragma once

#include <string>
#include <vector>

#include "mesh/mesh.hpp"

namespace microslip::mesh {

struct ElementShape {
  double aspect_ratio = 1.0;    ///< [-]
  double smallest_angle = 0.0;  ///< dihedral [rad]
  double largest_angle = 0.0;   ///< dihedral [rad]
};

/// @param nodes  coordinates of the nodes of one element, project order, n × 3 [m].
[[nodiscard]] ElementShape element_shape(ElementType type, const Eigen::MatrixX3d& nodes);

struct ShapeLimits {
  double aspect_ratio = 100.0;     ///< above: warned of
  double smallest_angle = 0.0175;  ///< 1° [rad]; below: warned of
  double largest_angle = 3.0892;   ///< 177° [rad]; above: warned of
};

/// Sentences for the log: how many elements are beyond a limit, and the worst of them by number and
/// place. Elements that are there once more count as well. Empty for a mesh without any.
[[nodiscard]] std::vector<std::string> shape_warnings(const Mesh& mesh,
                                                      const ShapeLimits& limits = {});

}  // namespace microslip::mesh
