#include "fem/fe_system.hpp"

#include <algorithm>
#include <vector>

#include "fem/petsc_check.hpp"

namespace microslip::fem {
namespace {

/// Rows of blocks [begin, end) that this rank owns, split evenly.
struct Share {
  PetscInt begin;
  PetscInt end;
};

Share share_of_rank(PetscInt n) {
  int rank = 0;
  int size = 1;
  MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
  MPI_Comm_size(PETSC_COMM_WORLD, &size);
  return {static_cast<PetscInt>(static_cast<long>(n) * rank / size),
          static_cast<PetscInt>(static_cast<long>(n) * (rank + 1) / size)};
}

/// Upper block rows owned here: sorted columns ≥ row.
using Pattern = std::vector<std::vector<PetscInt>>;

void add_clique(const std::vector<PetscInt>& nodes, const Share& rows, Pattern& pattern) {
  for (const PetscInt row : nodes) {
    if (row < rows.begin || row >= rows.end) continue;
    auto& columns = pattern[static_cast<std::size_t>(row - rows.begin)];
    for (const PetscInt column : nodes) {
      if (column >= row) columns.push_back(column);
    }
  }
}

std::vector<PetscInt> free_nodes(const mesh::ElementBlock& block, Eigen::Index element,
                                 const DofMap& dofs) {
  std::vector<PetscInt> nodes;
  for (const Eigen::Index node : block.connectivity.row(element)) {
    if (dofs.free_node(node) >= 0) nodes.push_back(dofs.free_node(node));
  }
  return nodes;
}

std::vector<std::vector<PetscInt>> spring_cliques(const SurfaceSprings& springs,
                                                  const DofMap& dofs) {
  std::vector<std::vector<PetscInt>> cliques(
      static_cast<std::size_t>(springs.interpolation.rows()));
  for (int node = 0; node < springs.interpolation.outerSize(); ++node) {
    for (Eigen::SparseMatrix<double>::InnerIterator it(springs.interpolation, node); it; ++it) {
      if (dofs.free_node(node) >= 0) {
        cliques[static_cast<std::size_t>(it.row())].push_back(dofs.free_node(node));
      }
    }
  }
  return cliques;
}

Pattern pattern_of(const mesh::Mesh& mesh, const DofMap& dofs, const SurfaceSprings* springs,
                   const Share& rows) {
  Pattern pattern(static_cast<std::size_t>(rows.end - rows.begin));
  for (const mesh::ElementBlock& block : mesh.elements()) {
    for (Eigen::Index e = 0; e < block.connectivity.rows(); ++e) {
      add_clique(free_nodes(block, e, dofs), rows, pattern);
    }
  }
  if (springs != nullptr) {
    for (const auto& clique : spring_cliques(*springs, dofs)) add_clique(clique, rows, pattern);
  }
  for (auto& columns : pattern) {
    std::sort(columns.begin(), columns.end());
    columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
  }
  return pattern;
}

MatHandle make_matrix(const DofMap& dofs, const Pattern& pattern, const Share& rows) {
  std::vector<PetscInt> own(pattern.size());
  std::vector<PetscInt> other(pattern.size());
  for (std::size_t i = 0; i < pattern.size(); ++i) {
    for (const PetscInt column : pattern[i]) ++(column < rows.end ? own : other)[i];
  }
  MatHandle matrix;
  const PetscInt local = 3 * (rows.end - rows.begin);
  const PetscInt global = 3 * dofs.n_free_nodes();
  check(MatCreate(PETSC_COMM_WORLD, matrix.out()));
  check(MatSetSizes(matrix.get(), local, local, global, global));
  check(MatSetBlockSize(matrix.get(), 3));
  check(MatSetType(matrix.get(), MATSBAIJ));
  check(MatXAIJSetPreallocation(matrix.get(), 3, own.data(), other.data(), own.data(),
                                other.data()));
  check(MatSetOption(matrix.get(), MAT_IGNORE_LOWER_TRIANGULAR, PETSC_TRUE));
  check(MatSetOption(matrix.get(), MAT_NEW_NONZERO_ALLOCATION_ERR, PETSC_TRUE));
  return matrix;
}

ElementMatrix blocks_of(const ElementMatrix& scalar) {
  ElementMatrix full = ElementMatrix::Zero(3 * scalar.rows(), 3 * scalar.rows());
  for (Eigen::Index a = 0; a < scalar.rows(); ++a) {
    for (Eigen::Index b = 0; b < scalar.rows(); ++b) {
      full.block<3, 3>(3 * a, 3 * b).diagonal().setConstant(scalar(a, b));
    }
  }
  return full;
}

void add_blocks(Mat matrix, const std::vector<PetscInt>& nodes, const ElementMatrix& values) {
  const auto n = static_cast<PetscInt>(nodes.size());
  check(MatSetValuesBlocked(matrix, n, nodes.data(), n, nodes.data(), values.data(), ADD_VALUES));
}

void add_elements(const mesh::Mesh& mesh, const DofMap& dofs, const mesh::ElementBlock& block,
                  const ElementIntegrator& integrator, FeSystem& system) {
  const Eigen::Index n = block.connectivity.cols();
  ElementNodes nodes(n, 3);
  std::vector<PetscInt> numbers(static_cast<std::size_t>(n));
  const Share share = share_of_rank(static_cast<PetscInt>(block.connectivity.rows()));
  for (PetscInt e = share.begin; e < share.end; ++e) {
    for (Eigen::Index a = 0; a < n; ++a) {
      const Eigen::Index node = block.connectivity(e, a);
      nodes.row(a) = mesh.nodes().row(node);
      numbers[static_cast<std::size_t>(a)] = dofs.free_node(node);
    }
    add_blocks(system.stiffness.get(), numbers, integrator.stiffness(nodes));
    add_blocks(system.mass.get(), numbers, blocks_of(integrator.scalar_mass(nodes)));
  }
}

void add_springs(const SurfaceSprings& springs, const DofMap& dofs, Mat stiffness) {
  const Eigen::SparseMatrix<double, Eigen::RowMajor> points = springs.interpolation;
  const Share share = share_of_rank(static_cast<PetscInt>(points.rows()));
  for (PetscInt point = share.begin; point < share.end; ++point) {
    const Eigen::Matrix3d k = springs.frame.transpose() *
                              springs.stiffness.row(point).asDiagonal() * springs.frame;
    for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator a(points, point); a; ++a) {
      for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator b(points, point); b; ++b) {
        const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> block = a.value() * b.value() * k;
        const PetscInt row = dofs.free_node(a.col());
        const PetscInt column = dofs.free_node(b.col());
        check(MatSetValuesBlocked(stiffness, 1, &row, 1, &column, block.data(), ADD_VALUES));
      }
    }
  }
}

void finish(Mat matrix) {
  check(MatAssemblyBegin(matrix, MAT_FINAL_ASSEMBLY));
  check(MatAssemblyEnd(matrix, MAT_FINAL_ASSEMBLY));
  check(MatSetOption(matrix, MAT_SYMMETRIC, PETSC_TRUE));
}

}  // namespace

FeSystem assemble(const mesh::Mesh& mesh, const DofMap& dofs, const Material& material,
                  StiffnessRule rule, const SurfaceSprings* springs) {
  check_material(material);
  const Share rows = share_of_rank(dofs.n_free_nodes());
  FeSystem system;
  {
    const Pattern pattern = pattern_of(mesh, dofs, springs, rows);
    system.stiffness = make_matrix(dofs, pattern, rows);
    system.mass = make_matrix(dofs, pattern, rows);
  }
  for (const mesh::ElementBlock& block : mesh.elements()) {
    add_elements(mesh, dofs, block, ElementIntegrator(block.type, material, rule), system);
  }
  if (springs != nullptr) add_springs(*springs, dofs, system.stiffness.get());
  finish(system.stiffness.get());
  finish(system.mass.get());
  return system;
}

VecHandle make_vector(Mat like) {
  VecHandle vector;
  check(MatCreateVecs(like, vector.out(), nullptr));
  return vector;
}

Eigen::VectorXd gather(Vec vector) {
  Handle<VecScatter, &VecScatterDestroy> to_all;
  VecHandle local;
  check(VecScatterCreateToAll(vector, to_all.out(), local.out()));
  check(VecScatterBegin(to_all.get(), vector, local.get(), INSERT_VALUES, SCATTER_FORWARD));
  check(VecScatterEnd(to_all.get(), vector, local.get(), INSERT_VALUES, SCATTER_FORWARD));
  PetscInt size = 0;
  check(VecGetLocalSize(local.get(), &size));
  const PetscScalar* values = nullptr;
  check(VecGetArrayRead(local.get(), &values));
  const Eigen::VectorXd full = Eigen::Map<const Eigen::VectorXd>(values, size);
  check(VecRestoreArrayRead(local.get(), &values));
  return full;
}

void scatter(const Eigen::VectorXd& full, Vec vector) {
  PetscInt begin = 0;
  PetscInt end = 0;
  check(VecGetOwnershipRange(vector, &begin, &end));
  PetscScalar* values = nullptr;
  check(VecGetArray(vector, &values));
  std::copy(full.data() + begin, full.data() + end, values);
  check(VecRestoreArray(vector, &values));
}

}  // namespace microslip::fem
