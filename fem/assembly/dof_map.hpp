/// @file
/// Which mesh nodes move, in which order the solver keeps them, and which rank owns them.
///
/// Supports hold all three components of a node, so a node either has three degrees of freedom or
/// none, and matrices keep blocks of three. The free nodes are ordered along a space-filling curve
/// (Morton, Z order): neighbours in space are near in memory, and a contiguous piece of the order
/// is a compact piece of the body, which serves as the share of one MPI rank.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "mesh/mesh.hpp"

namespace microslip::fem {

class DofMap {
 public:
  /// @param clamped  names of surfaces or node sets that are held.
  /// @throws mesh::MeshError  unknown name; std::invalid_argument  no node is left free.
  DofMap(const mesh::Mesh& mesh, const std::vector<std::string>& clamped, int rank, int n_ranks);

  /// Solver index of a mesh node, −1 if it is held.
  [[nodiscard]] Eigen::Index solver_node(Eigen::Index mesh_node) const {
    return solver_node_[static_cast<std::size_t>(mesh_node)];
  }
  /// Mesh node of a solver index.
  [[nodiscard]] Eigen::Index mesh_node(Eigen::Index solver_node) const {
    return mesh_node_[static_cast<std::size_t>(solver_node)];
  }
  [[nodiscard]] Eigen::Index n_mesh_nodes() const { return std::ssize(solver_node_); }
  [[nodiscard]] Eigen::Index n_free_nodes() const { return std::ssize(mesh_node_); }
  /// Solver nodes [first, last) belong to this rank.
  [[nodiscard]] Eigen::Index first() const { return first_; }
  [[nodiscard]] Eigen::Index last() const { return last_; }
  [[nodiscard]] Eigen::Index n_local_dofs() const { return 3 * (last_ - first_); }

  /// Rows of this rank, in solver order, of columns given per mesh node (3 n_mesh_nodes × m).
  [[nodiscard]] Eigen::MatrixXd to_local(const Eigen::MatrixXd& on_mesh) const;
  /// Complete columns per mesh node on every rank, 0 where held. Collective.
  [[nodiscard]] Eigen::MatrixXd to_mesh(const Eigen::MatrixXd& local) const;

 private:
  std::vector<Eigen::Index> solver_node_;
  std::vector<Eigen::Index> mesh_node_;
  Eigen::Index first_ = 0;
  Eigen::Index last_ = 0;
  int n_ranks_ = 1;
};

}  // namespace microslip::fem
