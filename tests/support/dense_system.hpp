/// @file
/// K and M of a small mesh as full matrices, summed element by element without PETSc: a reference
/// for everything the sparse solvers find.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "fem/material.hpp"
#include "mesh/mesh.hpp"

namespace microslip::test {

/// A φ = λ B φ with ΦᵀBΦ = I.
struct PencilPairs {
  Eigen::VectorXd values;   ///< ascending
  Eigen::MatrixXd vectors;  ///< columns
};
/// @param A, B  symmetric, B positive definite.
[[nodiscard]] PencilPairs pencil_pairs(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);

struct DenseSystem {
  Eigen::MatrixXd K;               ///< [N/m], free degrees of freedom
  Eigen::MatrixXd M;               ///< [kg]
  std::vector<Eigen::Index> dofs;  ///< 3 · mesh node + direction of each row

  /// Rows of the free degrees of freedom, and back with zeros at supports.
  [[nodiscard]] Eigen::MatrixXd reduce(const Eigen::MatrixXd& on_mesh) const {
    return on_mesh(dofs, Eigen::all);
  }
  [[nodiscard]] Eigen::MatrixXd expand(const Eigen::MatrixXd& free, Eigen::Index n_mesh_dofs) const;
  /// K⁻¹ F. @param on_mesh  F, a row per degree of freedom of the mesh.   @return likewise.
  [[nodiscard]] Eigen::MatrixXd solve(const Eigen::MatrixXd& on_mesh) const;
  /// All eigenvalues ω² [rad²/s²], ascending.
  [[nodiscard]] Eigen::VectorXd eigenvalues() const;
};

[[nodiscard]] DenseSystem dense_system(const mesh::Mesh& mesh, const fem::Material& material,
                                       const std::vector<std::string>& clamped);

}  // namespace microslip::test
