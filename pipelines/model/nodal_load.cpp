#include "pipelines/model/nodal_load.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "fem/surface_load.hpp"

namespace microslip::pipelines {
namespace {

/// Share of each mesh node, n_nodes, sum 1.
Eigen::VectorXd shares_of(const mesh::Mesh& mesh, const std::string& at) {
  if (is_spread(mesh, at)) {
    const Eigen::VectorXd areas = fem::nodal_areas(mesh.nodes(), mesh.surface(at));
    return areas / areas.sum();
  }
  const std::vector<Eigen::Index> nodes = mesh.node_set(at);
  Eigen::VectorXd shares = Eigen::VectorXd::Zero(mesh.n_nodes());
  for (const Eigen::Index node : nodes) shares[node] = 1.0 / static_cast<double>(nodes.size());
  return shares;
}

}  // namespace

bool is_spread(const mesh::Mesh& mesh, const std::string& at) {
  if (std::ranges::count(mesh.surface_names(), at) > 0) return true;
  return mesh.has_faces(at) && mesh.surface(at).nodes.size() == mesh.node_set(at).size();
}

Eigen::VectorXd unit_load(const mesh::Mesh& mesh, const std::string& at,
                          const Eigen::Vector3d& direction) {
  const Eigen::VectorXd shares = shares_of(mesh, at);
  Eigen::VectorXd load(3 * shares.size());
  for (Eigen::Index i = 0; i < shares.size(); ++i) load.segment<3>(3 * i) = shares[i] * direction;
  return load;
}

Eigen::MatrixX2d excitation_loads(const mesh::Mesh& mesh,
                                  const std::vector<ForceDescription>& forces) {
  Eigen::MatrixX2d loads = Eigen::MatrixX2d::Zero(3 * mesh.n_nodes(), 2);
  for (const ForceDescription& force : forces) {
    // F sin(θ + φ) = F cos φ sin θ + F sin φ cos θ
    const double phase = force.phase_deg * std::numbers::pi / 180.0;
    const Eigen::VectorXd load = force.amplitude * unit_load(mesh, force.at, force.direction);
    loads.col(0) += std::cos(phase) * load;
    if (force.phase_deg != 0.0) loads.col(1) += std::sin(phase) * load;
  }
  return loads;
}

}  // namespace microslip::pipelines
