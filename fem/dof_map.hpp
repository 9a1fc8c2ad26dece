/// @file
/// Which nodes move: clamped nodes are left out of the matrices, the others are numbered 0 … n_free − 1
/// in mesh order, three unknowns (x, y, z) each.
#pragma once

#include <vector>

#include <Eigen/Core>
#include <petscsys.h>

#include "mesh/mesh.hpp"

namespace microslip::fem {

class DofMap {
 public:
  /// @param clamped  names of surfaces or node sets.
  /// @throws mesh::MeshError        an unknown name.
  /// @throws std::invalid_argument  nothing is left to move.
  DofMap(const mesh::Mesh& mesh, const std::vector<std::string>& clamped);

  [[nodiscard]] PetscInt n_free_nodes() const { return n_free_; }
  /// Number of a node among the free ones; −1: clamped (PETSc skips negative indices).
  [[nodiscard]] PetscInt free_node(Eigen::Index node) const {
    return number_[static_cast<std::size_t>(node)];
  }
  [[nodiscard]] Eigen::Index n_nodes() const { return static_cast<Eigen::Index>(number_.size()); }
  /// The clamped nodes do not lie on one line: no rigid-body motion is left.
  [[nodiscard]] bool holds_rigid_motion() const { return holds_; }

  /// Values at free nodes (3 n_free) ↔ at all nodes (3 n_nodes), 0 where clamped.
  [[nodiscard]] Eigen::VectorXd expand(const Eigen::Ref<const Eigen::VectorXd>& free) const;
  [[nodiscard]] Eigen::VectorXd restrict(const Eigen::Ref<const Eigen::VectorXd>& all) const;

 private:
  std::vector<PetscInt> number_;
  PetscInt n_free_ = 0;
  bool holds_ = false;
};

}  // namespace microslip::fem
