/// @file
/// The elements a rank integrates: those that touch a node it owns,
/// so that nothing travels between ranks.
#pragma once

#include <array>

#include <petscsys.h>

#include "fem/assembly/dof_map.hpp"
#include "mesh/element_type.hpp"

namespace microslip::fem {

/// Solver node numbers of one element, −1 where held: what MatSetValuesBlocked ignores.
struct ElementDofs {
  std::array<PetscInt, mesh::most_element_nodes> index{};
  int n = 0;
};

[[nodiscard]] inline ElementDofs element_dofs(const DofMap& dofs, const mesh::ElementBlock& block,
                                              Eigen::Index element) {
  ElementDofs result;
  result.n = mesh::n_nodes(block.type);
  for (int i = 0; i < result.n; ++i) {
    result.index[static_cast<std::size_t>(i)] =
        static_cast<PetscInt>(dofs.solver_node(block.connectivity(element, i)));
  }
  return result;
}

[[nodiscard]] inline bool touches_own_rows(const DofMap& dofs, const ElementDofs& element) {
  for (int i = 0; i < element.n; ++i) {
    const Eigen::Index node = element.index[static_cast<std::size_t>(i)];
    if (node >= dofs.first() && node < dofs.last()) return true;
  }
  return false;
}

/// visit(block, element, its solver nodes) for every element that touches a node this rank owns.
template <typename Visit>
void for_own_elements(const mesh::Mesh& mesh, const DofMap& dofs, Visit visit) {
  for (const mesh::ElementBlock& block : mesh.elements()) {
    for (Eigen::Index e = 0; e < block.connectivity.rows(); ++e) {
      const ElementDofs element = element_dofs(dofs, block, e);
      if (touches_own_rows(dofs, element)) visit(block, e, element);
    }
  }
}

}  // namespace microslip::fem
