#include "fem/dof_map.hpp"

#include <set>
#include <stdexcept>

#include <Eigen/SVD>

namespace microslip::fem {
namespace {

/// Three points off one line hold a body: judged by the second singular value of their positions.
bool spans_a_plane(const Eigen::MatrixX3d& nodes, const std::set<Eigen::Index>& held) {
  if (held.size() < 3) return false;
  Eigen::MatrixX3d positions(static_cast<Eigen::Index>(held.size()), 3);
  Eigen::Index row = 0;
  for (const Eigen::Index node : held) positions.row(row++) = nodes.row(node);
  positions.rowwise() -= positions.colwise().mean().eval();
  const Eigen::Matrix3d moments = positions.transpose() * positions;
  const Eigen::Vector3d sizes = moments.jacobiSvd().singularValues();
  return sizes[1] > 1e-12 * sizes[0];  // squares of lengths: 1e-6 of the extent
}

}  // namespace

DofMap::DofMap(const mesh::Mesh& mesh, const std::vector<std::string>& clamped)
    : number_(static_cast<std::size_t>(mesh.n_nodes()), 0) {
  std::set<Eigen::Index> held;
  for (const std::string& name : clamped) {
    for (const Eigen::Index node : mesh.node_set(name)) held.insert(node);
  }
  for (const Eigen::Index node : held) number_[static_cast<std::size_t>(node)] = -1;
  for (PetscInt& number : number_) {
    if (number == 0) number = n_free_++;
  }
  if (n_free_ == 0) throw std::invalid_argument("supports: every node of the mesh is clamped");
  holds_ = spans_a_plane(mesh.nodes(), held);
}

Eigen::VectorXd DofMap::expand(const Eigen::Ref<const Eigen::VectorXd>& free) const {
  Eigen::VectorXd all = Eigen::VectorXd::Zero(3 * n_nodes());
  for (Eigen::Index node = 0; node < n_nodes(); ++node) {
    if (free_node(node) >= 0) all.segment<3>(3 * node) = free.segment<3>(3 * free_node(node));
  }
  return all;
}

Eigen::VectorXd DofMap::restrict(const Eigen::Ref<const Eigen::VectorXd>& all) const {
  Eigen::VectorXd free(3 * n_free_);
  for (Eigen::Index node = 0; node < n_nodes(); ++node) {
    if (free_node(node) >= 0) free.segment<3>(3 * free_node(node)) = all.segment<3>(3 * node);
  }
  return free;
}

}  // namespace microslip::fem
