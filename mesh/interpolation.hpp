/// @file
/// Fields of one mesh at the places of another.
#pragma once

#include <Eigen/SparseCore>

#include "mesh/mesh.hpp"

namespace microslip::mesh {

/// Values at `places` are this · values at the nodes of the mesh, by the shape functions of the
/// element that holds each; of the nearest one where a curved boundary of another mesh bulges
/// beyond this.
/// @param places  [m], n × 3.
/// @return n × n_nodes, rows that sum to 1.
/// @throws MeshError  a place that no element is near.
[[nodiscard]] Eigen::SparseMatrix<double, Eigen::RowMajor> interpolation(
    const Mesh& mesh, const Eigen::MatrixX3d& places);

}  // namespace microslip::mesh
