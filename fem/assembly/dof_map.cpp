#include "fem/assembly/dof_map.hpp"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <stdexcept>
#include <string>

#include <petscsys.h>

#include "fem/petsc/petsc_check.hpp"

namespace microslip::fem {
namespace {

// Spreads the low 21 bits of x to every third bit.
std::uint64_t spread_bits(std::uint64_t x) {
  x &= 0x1fffff;
  x = (x | x << 32) & 0x1f00000000ffff;
  x = (x | x << 16) & 0x1f0000ff0000ff;
  x = (x | x << 8) & 0x100f00f00f00f00f;
  x = (x | x << 4) & 0x10c30c30c30c30c3;
  return (x | x << 2) & 0x1249249249249249;
}

// Place of each node along the Morton curve through the bounding cube.
std::vector<std::uint64_t> morton_keys(const Eigen::MatrixX3d& nodes) {
  const Eigen::RowVector3d lower = nodes.colwise().minCoeff();
  const double size = (nodes.colwise().maxCoeff() - lower).maxCoeff();
  const double scale = size > 0.0 ? ((1 << 21) - 1) / size : 0.0;
  std::vector<std::uint64_t> keys(static_cast<std::size_t>(nodes.rows()));
  for (Eigen::Index i = 0; i < nodes.rows(); ++i) {
    std::uint64_t key = 0;
    for (int d = 0; d < 3; ++d) {
      key |= spread_bits(static_cast<std::uint64_t>((nodes(i, d) - lower[d]) * scale)) << d;
    }
    keys[static_cast<std::size_t>(i)] = key;
  }
  return keys;
}

Eigen::Index share_begin(Eigen::Index n, int rank, int n_ranks) { return n * rank / n_ranks; }

}  // namespace

DofMap::DofMap(const mesh::Mesh& mesh, const std::vector<std::string>& clamped, int rank,
               int n_ranks)
    : solver_node_(static_cast<std::size_t>(mesh.n_nodes()), 0), n_ranks_(n_ranks) {
  for (const std::string& name : clamped) {
    for (const Eigen::Index node : mesh.node_set(name))
      solver_node_[static_cast<std::size_t>(node)] = -1;
  }
  for (Eigen::Index node = 0; node < mesh.n_nodes(); ++node) {
    if (solver_node(node) >= 0) mesh_node_.push_back(node);
  }
  if (mesh_node_.empty()) throw std::invalid_argument("the supports hold every node of the mesh");
  const std::vector<std::uint64_t> keys = morton_keys(mesh.nodes());
  std::ranges::stable_sort(mesh_node_, {},
                           [&](Eigen::Index node) { return keys[static_cast<std::size_t>(node)]; });
  for (std::size_t i = 0; i < mesh_node_.size(); ++i) {
    solver_node_[static_cast<std::size_t>(mesh_node_[i])] = static_cast<Eigen::Index>(i);
  }
  first_ = share_begin(n_free_nodes(), rank, n_ranks);
  last_ = share_begin(n_free_nodes(), rank + 1, n_ranks);
}

Eigen::MatrixXd DofMap::to_local(const Eigen::MatrixXd& on_mesh) const {
  Eigen::MatrixXd local(n_local_dofs(), on_mesh.cols());
  for (Eigen::Index i = first_; i < last_; ++i) {
    local.middleRows<3>(3 * (i - first_)) = on_mesh.middleRows<3>(3 * mesh_node(i));
  }
  return local;
}

Eigen::MatrixXd DofMap::to_mesh(const Eigen::MatrixXd& local) const {
  std::vector<int> counts;
  std::vector<int> starts;
  for (int r = 0; r < n_ranks_; ++r) {
    starts.push_back(static_cast<int>(3 * share_begin(n_free_nodes(), r, n_ranks_)));
    counts.push_back(static_cast<int>(3 * share_begin(n_free_nodes(), r + 1, n_ranks_)) -
                     starts.back());
  }
  Eigen::MatrixXd on_mesh = Eigen::MatrixXd::Zero(3 * n_mesh_nodes(), local.cols());
  Eigen::VectorXd all(3 * n_free_nodes());
  for (Eigen::Index column = 0; column < local.cols(); ++column) {
    check(MPI_Allgatherv(local.col(column).data(), static_cast<int>(local.rows()), MPI_DOUBLE,
                         all.data(), counts.data(), starts.data(), MPI_DOUBLE, PETSC_COMM_WORLD));
    for (Eigen::Index i = 0; i < n_free_nodes(); ++i) {
      on_mesh.block<3, 1>(3 * mesh_node(i), column) = all.segment<3>(3 * i);
    }
  }
  return on_mesh;
}

}  // namespace microslip::fem
