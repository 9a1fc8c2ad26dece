#include "tests/support/dense_system.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "fem/elements/element_matrices.hpp"

namespace microslip::test {

Eigen::MatrixXd DenseSystem::expand(const Eigen::MatrixXd& free, Eigen::Index n_mesh_dofs) const {
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(n_mesh_dofs, free.cols());
  all(dofs, Eigen::all) = free;
  return all;
}

PencilPairs pencil_pairs(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> eigen(A, B);
  return {eigen.eigenvalues(), eigen.eigenvectors()};
}

Eigen::MatrixXd DenseSystem::solve(const Eigen::MatrixXd& on_mesh) const {
  return expand(K.llt().solve(reduce(on_mesh)), on_mesh.rows());
}

Eigen::VectorXd DenseSystem::eigenvalues() const {
  return Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>(K, M, Eigen::EigenvaluesOnly)
      .eigenvalues();
}

DenseSystem dense_system(const mesh::Mesh& mesh, const fem::Material& material,
                         const std::vector<std::string>& clamped) {
  const Eigen::Index n = 3 * mesh.n_nodes();
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(n, n);
  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(n, n);
  fem::ElementMatrices element;
  for (const mesh::ElementBlock& block : mesh.elements()) {
    for (Eigen::Index e = 0; e < block.connectivity.rows(); ++e) {
      const Eigen::VectorX<Eigen::Index> node = block.connectivity.row(e).transpose();
      fem::element_matrices(block.type, mesh.nodes()(node, Eigen::all), material,
                            fem::Tet10Rule::accurate, element);
      for (Eigen::Index i = 0; i < node.size(); ++i) {
        for (Eigen::Index j = 0; j < node.size(); ++j) {
          K.block<3, 3>(3 * node[i], 3 * node[j]) += element.stiffness.block<3, 3>(3 * i, 3 * j);
          M.block<3, 3>(3 * node[i], 3 * node[j]).diagonal().array() += element.mass(i, j);
        }
      }
    }
  }
  std::vector<bool> held(static_cast<std::size_t>(mesh.n_nodes()), false);
  for (const std::string& name : clamped) {
    for (const Eigen::Index node : mesh.node_set(name)) held[static_cast<std::size_t>(node)] = true;
  }
  DenseSystem system;
  for (Eigen::Index dof = 0; dof < n; ++dof) {
    if (!held[static_cast<std::size_t>(dof / 3)]) system.dofs.push_back(dof);
  }
  system.K = K(system.dofs, system.dofs);
  system.M = M(system.dofs, system.dofs);
  return system;
}

}  // namespace microslip::test
