#include "pipelines/import/given_matrices.hpp"

#include <string>
#include <vector>

#include <fmt/format.h>

#include "mesh/count_text.hpp"
#include "pipelines/import/matrix_checks.hpp"
#include "pipelines/import/node_rows.hpp"
#include "pipelines/scene/matrix_files.hpp"
#include "pipelines/system/scene_error.hpp"

namespace microslip::pipelines {
namespace {

using Sparse = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// 3 n_nodes × rows of a matrix: 1 where a displacement of the mesh has that row.
Sparse selection(const NodeRows& nodes, const std::vector<Eigen::Index>& rows, Eigen::Index n) {
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (int d = 0; d < 3; ++d) {
      const Eigen::Index row = nodes.row(rows[i], d);
      if (row < 0) continue;
      entries.emplace_back(static_cast<int>(3 * i) + d, static_cast<int>(row), 1.0);
    }
  }
  Sparse result(3 * std::ssize(rows), n);
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

}  // namespace

fem::GivenMatrices matrices_of(const mesh::Mesh& mesh, const SceneDescription& scene) {
  const MatrixFiles& files = *given_matrices(scene);
  const double length_unit = std::get<MeshFileModel>(scene.model).length_unit.value();
  const Sparse K = read_matrix_market(files.stiffness);
  const Sparse M = read_matrix_market(files.mass);
  if (K.rows() != M.rows()) {
    throw SceneError(fmt::format("{} has {}, {} has {}", files.stiffness.string(),
                                 mesh::counted(K.rows(), "row", "rows"), files.mass.string(),
                                 M.rows()));
  }
  const NodeRows nodes = read_node_rows(files.nodes, K.rows());
  const std::vector<Eigen::Index> rows =
      rows_of_nodes(mesh, length_unit * nodes.places, files.nodes, files.place);
  const Sparse S = selection(nodes, rows, K.rows());
  if (S.nonZeros() < K.rows()) {
    throw SceneError(
        fmt::format("{}: {} to nodes that the mesh has not", files.place,
                    mesh::counted(K.rows() - S.nonZeros(), "row of the matrices belongs",
                                  "rows of the matrices belong")));
  }
  fem::GivenMatrices matrices{(1.0 / length_unit) * (S * K * S.transpose()),
                              files.mass_unit * (S * M * S.transpose())};
  check_matrices(mesh, matrices, {files.stiffness, files.mass, files.nodes});
  return matrices;
}

}  // namespace microslip::pipelines
