#include "fem/assembly/corner_interpolation.hpp"

#include <array>
#include <cstddef>
#include <vector>

#include "fem/assembly/edge_nodes.hpp"
#include "fem/assembly/own_elements.hpp"
#include "fem/petsc/petsc_check.hpp"
#include "mesh/shape_functions.hpp"

namespace microslip::fem {
namespace {

constexpr PetscInt ends = 2;       // of an edge
constexpr double rounding = 1e-6;  // of N_c, which is 0 or 1/2 at a node on an edge

/// Number of each corner among the corners that are free, by its solver node; −1 of other nodes.
struct Corners {
  std::vector<PetscInt> number;
  PetscInt first = 0;  ///< [first, last) belong to this rank
  PetscInt last = 0;
  PetscInt n = 0;  ///< on all ranks
};

Corners free_corners(const mesh::Mesh& mesh, const DofMap& dofs) {
  Corners corners{std::vector<PetscInt>(static_cast<std::size_t>(dofs.n_free_nodes()), -1)};
  for (const mesh::ElementBlock& block : mesh.elements()) {
    for (const auto node : block.connectivity.leftCols(mesh::n_corners(block.type)).reshaped()) {
      const Eigen::Index solver_node = dofs.solver_node(node);
      if (solver_node >= 0) corners.number[static_cast<std::size_t>(solver_node)] = 0;
    }
  }
  PetscInt n = 0;
  for (Eigen::Index node = 0; node < dofs.n_free_nodes(); ++node) {
    PetscInt& number = corners.number[static_cast<std::size_t>(node)];
    if (number == 0) number = n++;
    if (node < dofs.first()) corners.first = n;
    if (node < dofs.last()) corners.last = n;
  }
  corners.n = n;
  return corners;
}

/// N_c at the nodes of each type of element, nodes × corners.
class CornerShapes {
 public:
  CornerShapes() {
    for (const mesh::ElementType type : mesh::all_element_types) {
      const Eigen::MatrixX3d places = mesh::reference_nodes(type);
      Eigen::MatrixXd& values = values_[static_cast<std::size_t>(type)];
      values.resize(places.rows(), mesh::n_corners(type));
      for (Eigen::Index i = 0; i < places.rows(); ++i) {
        values.row(i) =
            mesh::shapes(mesh::linear(type), places.row(i).transpose()).values.transpose();
      }
    }
  }
  const Eigen::MatrixXd& of(mesh::ElementType type) const {
    return values_[static_cast<std::size_t>(type)];
  }

 private:
  std::array<Eigen::MatrixXd, mesh::all_element_types.size()> values_;
};

MatHandle make_matrix(const DofMap& dofs, const Corners& corners) {
  MatHandle matrix;
  check(MatCreate(PETSC_COMM_WORLD, matrix.out()));
  check(MatSetSizes(matrix.get(), static_cast<PetscInt>(dofs.n_local_dofs()),
                    3 * (corners.last - corners.first), PETSC_DETERMINE, PETSC_DETERMINE));
  check(MatSetType(matrix.get(), MATAIJ));
  check(MatSetBlockSizes(matrix.get(), 3, 3));
  check(MatSeqAIJSetPreallocation(matrix.get(), ends, nullptr));
  check(MatMPIAIJSetPreallocation(matrix.get(), ends, nullptr, ends, nullptr));
  return matrix;
}

}  // namespace

MatHandle corner_interpolation(const mesh::Mesh& mesh, const DofMap& dofs) {
  if (!has_edge_nodes(mesh)) return {};
  const Corners corners = free_corners(mesh, dofs);
  if (corners.n == 0) return {};
  MatHandle matrix = make_matrix(dofs, corners);
  const auto set = [&](PetscInt node, PetscInt corner, double value) {
    for (PetscInt axis = 0; axis < 3; ++axis) {
      check(MatSetValue(matrix.get(), 3 * node + axis, 3 * corner + axis, value, INSERT_VALUES));
    }
  };
  const auto number = [&](PetscInt node) { return corners.number[static_cast<std::size_t>(node)]; };
  const CornerShapes shapes;
  std::vector<bool> is_set(static_cast<std::size_t>(dofs.last() - dofs.first()), false);
  const auto set_once = [&](const mesh::ElementBlock& block, Eigen::Index,
                            const ElementDofs& element) {
    const Eigen::MatrixXd& N = shapes.of(block.type);
    for (int i = 0; i < element.n; ++i) {
      const PetscInt node = element.index[static_cast<std::size_t>(i)];
      if (node < dofs.first() || node >= dofs.last()) continue;
      if (is_set[static_cast<std::size_t>(node - dofs.first())]) continue;
      is_set[static_cast<std::size_t>(node - dofs.first())] = true;
      if (number(node) >= 0) {
        set(node, number(node), 1.0);
        continue;
      }
      for (Eigen::Index c = 0; c < N.cols(); ++c) {
        const PetscInt corner = element.index[static_cast<std::size_t>(c)];
        if (corner >= 0 && N(i, c) > rounding) set(node, number(corner), N(i, c));
      }
    }
  };
  for_own_elements(mesh, dofs, set_once);
  check(MatAssemblyBegin(matrix.get(), MAT_FINAL_ASSEMBLY));
  check(MatAssemblyEnd(matrix.get(), MAT_FINAL_ASSEMBLY));
  return matrix;
}

}  // namespace microslip::fem
