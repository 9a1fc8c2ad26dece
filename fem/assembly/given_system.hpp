/// @file
/// Stiffness and mass of another code as a system of PETSc.
#pragma once

#include "fem/assembly/fe_system.hpp"
#include "fem/given_matrices.hpp"

namespace microslip::fem {

/// Nodes without any free displacement are left out. A held displacement of another node stays,
/// with the largest stiffness of K, a small mass and no coupling: its mode lies beyond all others.
/// @throws std::invalid_argument  matrices of another size than 3 n_nodes, or everything held.
[[nodiscard]] FeSystem given_system(const mesh::Mesh& mesh, const GivenMatrices& matrices);

}  // namespace microslip::fem
