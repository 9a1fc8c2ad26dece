/// @file
/// A structure as matrices of PETSc: what answers for a Structure.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "fem/eigen/structure_solver.hpp"

namespace microslip::fem {

/// As the first constructor of Structure.
[[nodiscard]] std::unique_ptr<StructureSolver> assembled_structure(
    const mesh::Mesh& mesh, const Material& material, const std::vector<std::string>& clamped,
    Tet10Rule rule, SolverKind solver);
/// As the second.
[[nodiscard]] std::unique_ptr<StructureSolver> given_structure(const mesh::Mesh& mesh,
                                                               const GivenMatrices& matrices,
                                                               SolverKind solver);

}  // namespace microslip::fem
