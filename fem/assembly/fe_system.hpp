/// @file
/// Stiffness and mass of a meshed body in PETSc: symmetric, blocks of three, upper half stored
/// (MATSBAIJ), distributed over the ranks of PETSC_COMM_WORLD by rows.
#pragma once

#include <string>
#include <vector>

#include "fem/assembly/dof_map.hpp"
#include "fem/elements/element_matrices.hpp"
#include "fem/petsc/handle.hpp"

namespace microslip::fem {

struct FeSystem {
  DofMap dofs;
  MatHandle stiffness;    ///< K [N/m], n_dofs × n_dofs, solver order
  MatHandle mass_matrix;  ///< M [kg], same pattern
  double mass = 0.0;      ///< of the whole mesh, held nodes included [kg]
};

/// Sums the element matrices of all elements. Each rank integrates every element that touches a
/// node it owns and keeps its own rows, so nothing travels between ranks.
/// @param clamped  names of surfaces or node sets that are held.
/// @throws mesh::MeshError  an unknown name; std::invalid_argument  a material out of range.
/// @note One and several ranks agree to summation order (1e-15 relative).
[[nodiscard]] FeSystem assemble(const mesh::Mesh& mesh, const Material& material,
                                const std::vector<std::string>& clamped,
                                Tet10Rule rule = Tet10Rule::accurate);

}  // namespace microslip::fem
