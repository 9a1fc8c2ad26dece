#include "fem/assembly/surface_springs.hpp"

#include <stdexcept>
#include <string>

#include "fem/petsc_error.hpp"

namespace microslip::fem {
namespace {

void check_sizes(const mesh::Surface& surface, const Eigen::SparseMatrix<double>& to_points,
                 const Eigen::VectorXd& weights, const Eigen::MatrixX3d& stiffness) {
  const auto refuse = [](const std::string& what, Eigen::Index is, Eigen::Index expected) {
    throw std::invalid_argument("springs: " + what + " = " + std::to_string(is) + ", expected " +
                                std::to_string(expected));
  };
  const Eigen::Index n_nodes = std::ssize(surface.nodes);
  if (to_points.cols() != n_nodes) refuse("columns of to_points", to_points.cols(), n_nodes);
  if (weights.size() != to_points.rows())
    refuse("number of weights", weights.size(), to_points.rows());
  if (stiffness.rows() != to_points.rows())
    refuse("rows of stiffness", stiffness.rows(), to_points.rows());
}

}  // namespace

void add_springs(FeSystem& system, const mesh::Surface& surface,
                 const Eigen::SparseMatrix<double>& to_points, const Eigen::VectorXd& weights,
                 const Eigen::Matrix3d& frame, const Eigen::MatrixX3d& stiffness) {
  check_sizes(surface, to_points, weights, stiffness);
  const Eigen::SparseMatrix<double, Eigen::RowMajor> points(to_points);
  const Mat K = system.stiffness.get();
  std::vector<PetscInt> index;
  std::vector<double> N;
  NodeBlocks block;
  for (Eigen::Index c = 0; c < points.rows(); ++c) {
    index.clear();
    N.clear();
    for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator it(points, c); it; ++it) {
      const Eigen::Index node = surface.nodes[static_cast<std::size_t>(it.col())];
      index.push_back(static_cast<PetscInt>(system.dofs.solver_node(node)));
      N.push_back(it.value());
    }
    const Eigen::Matrix3d spring =
        weights[c] * frame.transpose() * stiffness.row(c).asDiagonal() * frame;
    const auto n = static_cast<Eigen::Index>(N.size());
    block.resize(3 * n, 3 * n);
    for (Eigen::Index i = 0; i < n; ++i) {
      for (Eigen::Index j = 0; j < n; ++j) {
        block.block<3, 3>(3 * i, 3 * j) =
            N[static_cast<std::size_t>(i)] * N[static_cast<std::size_t>(j)] * spring;
      }
    }
    const auto n_nodes = static_cast<PetscInt>(n);
    check(MatSetValuesBlocked(K, n_nodes, index.data(), n_nodes, index.data(), block.data(),
                              ADD_VALUES));
  }
  check(MatAssemblyBegin(K, MAT_FINAL_ASSEMBLY));
  check(MatAssemblyEnd(K, MAT_FINAL_ASSEMBLY));
}

}  // namespace microslip::fem
