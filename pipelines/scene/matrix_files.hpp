/// @file
/// Stiffness and mass of another code as files: Matrix Market,
/// and a table of the nodes their rows belong to.
#pragma once

#include <filesystem>

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace microslip::pipelines {

/// A real matrix in coordinates, symmetric or general, whole: both halves.
/// @throws SceneError  "file:line: …": missing, not such a matrix, an entry outside it or not a
///         number, an end too soon, a general matrix that is not symmetric within 1e-9 of its
///         largest entry: which entries.
/// Source: Boisvert, Pozo & Remington, The Matrix Market exchange formats, NISTIR 5935 (1996).
[[nodiscard]] Eigen::SparseMatrix<double, Eigen::RowMajor> read_matrix_market(
    const std::filesystem::path& file);

/// Where the displacements of nodes stand in matrices.
struct NodeRows {
  Eigen::MatrixX3d places;                             ///< of the nodes, in the unit of the file
  Eigen::Matrix<Eigen::Index, Eigen::Dynamic, 3> row;  ///< of x, y, z, from 0; −1: held
};

/// Columns x, y, z, ux, uy, uz. @param n_rows  of the matrices: each belongs to one displacement.
/// @throws SceneError  "file:line: column: …": no such row, one that has a displacement already,
///         or none.
[[nodiscard]] NodeRows read_node_rows(const std::filesystem::path& file, Eigen::Index n_rows);

}  // namespace microslip::pipelines
