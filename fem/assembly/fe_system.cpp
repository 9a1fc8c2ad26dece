#include "fem/assembly/fe_system.hpp"

#include "fem/assembly/own_elements.hpp"
#include "fem/petsc/petsc_check.hpp"

namespace microslip::fem {
namespace {

// Elements around each own node, in compressed form.
struct NodeElements {
  std::vector<std::size_t> start;
  std::vector<ElementDofs> elements;
  std::vector<std::size_t> element;

  NodeElements(const mesh::Mesh& mesh, const DofMap& dofs)
      : start(static_cast<std::size_t>(dofs.last() - dofs.first()) + 1, 0) {
    for_own_elements(mesh, dofs, [&](const auto&, Eigen::Index, const ElementDofs& dof) {
      elements.push_back(dof);
    });
    const auto for_own_nodes = [&](auto visit) {
      for (std::size_t e = 0; e < elements.size(); ++e) {
        for (int i = 0; i < elements[e].n; ++i) {
          const Eigen::Index node = elements[e].index[static_cast<std::size_t>(i)];
          if (node >= dofs.first() && node < dofs.last())
            visit(static_cast<std::size_t>(node - dofs.first()), e);
        }
      }
    };
    for_own_nodes([&](std::size_t node, std::size_t) { ++start[node + 1]; });
    for (std::size_t i = 1; i < start.size(); ++i) start[i] += start[i - 1];
    element.resize(start.back());
    std::vector<std::size_t> fill(start.begin(), start.end() - 1);
    for_own_nodes([&](std::size_t node, std::size_t e) { element[fill[node]++] = e; });
  }
};

// Blocks per own row in the upper triangle: columns owned here (diagonal included), and elsewhere.
struct RowCounts {
  std::vector<PetscInt> own;
  std::vector<PetscInt> other;
};

RowCounts count_blocks(const mesh::Mesh& mesh, const DofMap& dofs) {
  const NodeElements around(mesh, dofs);
  const std::size_t n_rows = around.start.size() - 1;
  RowCounts counts{std::vector<PetscInt>(n_rows, 0), std::vector<PetscInt>(n_rows, 0)};
  std::vector<std::size_t> last_row(static_cast<std::size_t>(dofs.n_free_nodes()), n_rows);
  for (std::size_t row = 0; row < n_rows; ++row) {
    const Eigen::Index node = dofs.first() + static_cast<Eigen::Index>(row);
    for (std::size_t k = around.start[row]; k < around.start[row + 1]; ++k) {
      const ElementDofs& element = around.elements[around.element[k]];
      for (int i = 0; i < element.n; ++i) {
        const Eigen::Index column = element.index[static_cast<std::size_t>(i)];
        if (column < node || last_row[static_cast<std::size_t>(column)] == row) continue;
        last_row[static_cast<std::size_t>(column)] = row;
        ++(column < dofs.last() ? counts.own : counts.other)[row];
      }
    }
  }
  return counts;
}

MatHandle make_matrix(const DofMap& dofs, const RowCounts& counts) {
  MatHandle matrix;
  check(MatCreate(PETSC_COMM_WORLD, matrix.out()));
  const auto n_local = static_cast<PetscInt>(dofs.n_local_dofs());
  const auto n = static_cast<PetscInt>(3 * dofs.n_free_nodes());
  check(MatSetSizes(matrix.get(), n_local, n_local, n, n));
  check(MatSetType(matrix.get(), MATSBAIJ));
  check(MatXAIJSetPreallocation(matrix.get(), 3, nullptr, nullptr, counts.own.data(),
                                counts.other.data()));
  check(MatSetOption(matrix.get(), MAT_IGNORE_LOWER_TRIANGULAR, PETSC_TRUE));
  check(MatSetOption(matrix.get(), MAT_IGNORE_OFF_PROC_ENTRIES, PETSC_TRUE));
  check(MatSetOption(matrix.get(), MAT_NEW_NONZERO_ALLOCATION_ERR, PETSC_TRUE));
  return matrix;
}

// m_ij I as 3 × 3 blocks.
void expand_mass(const Eigen::MatrixXd& scalar, NodeBlocks& blocks) {
  blocks.setZero(3 * scalar.rows(), 3 * scalar.cols());
  for (Eigen::Index i = 0; i < scalar.rows(); ++i) {
    for (Eigen::Index j = 0; j < scalar.cols(); ++j) {
      blocks.block<3, 3>(3 * i, 3 * j).diagonal().setConstant(scalar(i, j));
    }
  }
}

void finish(Mat matrix) {
  check(MatAssemblyBegin(matrix, MAT_FINAL_ASSEMBLY));
  check(MatAssemblyEnd(matrix, MAT_FINAL_ASSEMBLY));
  check(MatSetOption(matrix, MAT_SYMMETRIC, PETSC_TRUE));
  check(MatSetOption(matrix, MAT_SYMMETRY_ETERNAL, PETSC_TRUE));
}

}  // namespace

FeSystem assemble(const mesh::Mesh& mesh, const Material& material,
                  const std::vector<std::string>& clamped, Tet10Rule rule) {
  check_material(material);
  int rank = 0;
  int n_ranks = 1;
  check(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  check(MPI_Comm_size(PETSC_COMM_WORLD, &n_ranks));
  FeSystem system{DofMap(mesh, clamped, rank, n_ranks), {}, {}, material.density * mesh.volume()};
  const RowCounts counts = count_blocks(mesh, system.dofs);
  system.stiffness = make_matrix(system.dofs, counts);
  system.mass_matrix = make_matrix(system.dofs, counts);

  ElementMatrices matrices;
  NodeBlocks mass_blocks;
  Eigen::MatrixX3d coordinates;
  const auto add = [&](const mesh::ElementBlock& block, Eigen::Index e,
                       const ElementDofs& element) {
    coordinates = mesh.nodes()(block.connectivity.row(e).transpose(), Eigen::all);
    element_matrices(block.type, coordinates, material, rule, matrices);
    expand_mass(matrices.mass, mass_blocks);
    check(MatSetValuesBlocked(system.stiffness.get(), element.n, element.index.data(), element.n,
                              element.index.data(), matrices.stiffness.data(), ADD_VALUES));
    check(MatSetValuesBlocked(system.mass_matrix.get(), element.n, element.index.data(), element.n,
                              element.index.data(), mass_blocks.data(), ADD_VALUES));
  };
  for_own_elements(mesh, system.dofs, add);
  finish(system.stiffness.get());
  finish(system.mass_matrix.get());
  check(MatSetOption(system.mass_matrix.get(), MAT_SPD, PETSC_TRUE));
  return system;
}

}  // namespace microslip::fem
