#include "fem/assembly/given_system.hpp"

#include <stdexcept>
#include <string>
#include <vector>

#include "fem/petsc/petsc_check.hpp"

namespace microslip::fem {
namespace {

using Sparse = Eigen::SparseMatrix<double, Eigen::RowMajor>;

constexpr double light = 1e-9;  // of the mean mass of a displacement: frequencies beyond all others

void check_size(const Sparse& matrix, const char* name, Eigen::Index n) {
  if (matrix.rows() == n && matrix.cols() == n) return;
  throw std::invalid_argument(std::string(name) + " is " + std::to_string(matrix.rows()) + " x " +
                              std::to_string(matrix.cols()) + ", 3 per mesh node are " +
                              std::to_string(n));
}

std::vector<Eigen::Index> held_nodes(const Eigen::ArrayX<bool>& held) {
  std::vector<Eigen::Index> nodes;
  for (Eigen::Index node = 0; node < held.size() / 3; ++node) {
    if (held.segment<3>(3 * node).all()) nodes.push_back(node);
  }
  return nodes;
}

/// Blocks per own row of nodes in the upper half: columns owned here (diagonal included),
/// and elsewhere.
struct RowCounts {
  std::vector<PetscInt> own;
  std::vector<PetscInt> other;
};

RowCounts count_blocks(const Sparse& matrix, const DofMap& dofs) {
  const auto n_rows = static_cast<std::size_t>(dofs.last() - dofs.first());
  RowCounts counts{std::vector<PetscInt>(n_rows, 1), std::vector<PetscInt>(n_rows, 0)};
  std::vector<Eigen::Index> last(static_cast<std::size_t>(dofs.n_free_nodes()), -1);
  for (Eigen::Index row = dofs.first(); row < dofs.last(); ++row) {
    for (int d = 0; d < 3; ++d) {
      for (Sparse::InnerIterator entry(matrix, 3 * dofs.mesh_node(row) + d); entry; ++entry) {
        const Eigen::Index column = dofs.solver_node(entry.col() / 3);
        if (column <= row || last[static_cast<std::size_t>(column)] == row) continue;
        last[static_cast<std::size_t>(column)] = row;
        ++(column < dofs.last() ? counts.own
                                : counts.other)[static_cast<std::size_t>(row - dofs.first())];
      }
    }
  }
  return counts;
}

PetscInt solver_row(const DofMap& dofs, Eigen::Index row) {
  const Eigen::Index node = dofs.solver_node(row / 3);
  return static_cast<PetscInt>(node < 0 ? -1 : 3 * node + row % 3);
}

/// @param alone  diagonal of held displacements that stay.
MatHandle petsc_matrix(const Sparse& matrix, const DofMap& dofs, const Eigen::ArrayX<bool>& held,
                       double alone) {
  MatHandle result;
  const auto n = static_cast<PetscInt>(3 * dofs.n_free_nodes());
  const auto n_local = static_cast<PetscInt>(dofs.n_local_dofs());
  const RowCounts counts = count_blocks(matrix, dofs);
  check(MatCreate(PETSC_COMM_WORLD, result.out()));
  check(MatSetSizes(result.get(), n_local, n_local, n, n));
  check(MatSetType(result.get(), MATSBAIJ));
  check(MatXAIJSetPreallocation(result.get(), 3, nullptr, nullptr, counts.own.data(),
                                counts.other.data()));
  check(MatSetOption(result.get(), MAT_IGNORE_LOWER_TRIANGULAR, PETSC_TRUE));
  for (Eigen::Index node = dofs.first(); node < dofs.last(); ++node) {
    for (int d = 0; d < 3; ++d) {
      const Eigen::Index row = 3 * dofs.mesh_node(node) + d;
      const PetscInt i = solver_row(dofs, row);
      for (Sparse::InnerIterator entry(matrix, row); entry; ++entry) {
        const PetscInt j = solver_row(dofs, entry.col());
        if (j < 0 || held[row] || held[entry.col()]) continue;
        check(MatSetValue(result.get(), i, j, entry.value(), INSERT_VALUES));
      }
      if (held[row]) check(MatSetValue(result.get(), i, i, alone, INSERT_VALUES));
    }
  }
  check(MatAssemblyBegin(result.get(), MAT_FINAL_ASSEMBLY));
  check(MatAssemblyEnd(result.get(), MAT_FINAL_ASSEMBLY));
  check(MatSetOption(result.get(), MAT_SYMMETRIC, PETSC_TRUE));
  check(MatSetOption(result.get(), MAT_SYMMETRY_ETERNAL, PETSC_TRUE));
  return result;
}

}  // namespace

FeSystem given_system(const mesh::Mesh& mesh, const GivenMatrices& matrices) {
  check_size(matrices.stiffness, "K", 3 * mesh.n_nodes());
  check_size(matrices.mass, "M", 3 * mesh.n_nodes());
  int rank = 0;
  int n_ranks = 1;
  check(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  check(MPI_Comm_size(PETSC_COMM_WORLD, &n_ranks));
  const Eigen::ArrayXd stiffness = matrices.stiffness.diagonal();
  const Eigen::ArrayXd mass = matrices.mass.diagonal();
  const Eigen::ArrayX<bool> held = stiffness == 0.0 && mass == 0.0;
  // DofMap knows supports by name.
  mesh::Mesh supported = mesh;
  const std::string name = "held displacements of K and M";
  supported.name_nodes(name, held_nodes(held));
  FeSystem system{DofMap(supported, {name}, rank, n_ranks), {}, {}, matrices.mass.sum() / 3.0};
  system.stiffness = petsc_matrix(matrices.stiffness, system.dofs, held, stiffness.maxCoeff());
  system.mass_matrix = petsc_matrix(matrices.mass, system.dofs, held, light * mass.mean());
  check(MatSetOption(system.mass_matrix.get(), MAT_SPD, PETSC_TRUE));
  return system;
}

}  // namespace microslip::fem
