/// @file
/// The skin of a mesh: the faces that belong to one element only.
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "mesh/mesh.hpp"

namespace microslip::mesh {

/// Corner nodes of every outer face in outward order, as the elements have them; the last of a
/// triangle is −1. In an order that depends on the mesh alone.
[[nodiscard]] std::vector<std::array<Eigen::Index, 4>> outer_faces(const Mesh& mesh);

}  // namespace microslip::mesh
