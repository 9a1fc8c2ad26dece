/// @file
/// Displacements of the corners of quadratic elements → of all nodes: the level below the finest of
/// multigrid.
///
///   u_i = Σ_c N_c(ξ_i) u_c                                                                     (1)
///
/// N_c are the shape functions of the linear element with the same corners: a node on an edge moves
/// as the mean of its ends, so that all displacements linear in x, y, z are there, the rigid-body
/// motions among them.
#pragma once

#include "fem/assembly/dof_map.hpp"
#include "fem/petsc/handle.hpp"
#include "mesh/mesh.hpp"

namespace microslip::fem {

/// @return  3 n_free_nodes × 3 n_free_corners, rows and columns of a rank as it owns the nodes;
///          corners in solver order. Empty: there are corners only, or none is free.
[[nodiscard]] MatHandle corner_interpolation(const mesh::Mesh& mesh, const DofMap& dofs);

}  // namespace microslip::fem
