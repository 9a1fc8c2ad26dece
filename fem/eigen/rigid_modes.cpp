#include "fem/eigen/rigid_modes.hpp"

#include <numeric>

#include <Eigen/Geometry>

#include "fem/elements/symmetric_pairs.hpp"
#include "fem/petsc/columns.hpp"

namespace microslip::fem {
namespace {

using Motion = Eigen::Matrix<double, 3, 6>;

// Parts of the mesh, by union–find over the nodes of each element.
std::vector<std::size_t> part_of_node(const mesh::Mesh& mesh) {
  std::vector<std::size_t> parent(static_cast<std::size_t>(mesh.n_nodes()));
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto root = [&](std::size_t node) {
    while (parent[node] != node) node = parent[node] = parent[parent[node]];
    return node;
  };
  for (const mesh::ElementBlock& block : mesh.elements()) {
    for (Eigen::Index e = 0; e < block.connectivity.rows(); ++e) {
      const std::size_t first = root(static_cast<std::size_t>(block.connectivity(e, 0)));
      for (Eigen::Index i = 1; i < block.connectivity.cols(); ++i) {
        parent[root(static_cast<std::size_t>(block.connectivity(e, i)))] = first;
      }
    }
  }
  for (std::size_t node = 0; node < parent.size(); ++node) parent[node] = root(node);
  return parent;
}

// Displacement of a point under unit translations and rotations, lengths measured in `size`.
Motion rigid_motion(const Eigen::Vector3d& x) {
  Motion motion = Motion::Zero();
  motion.leftCols<3>().setIdentity();
  for (int axis = 0; axis < 3; ++axis) motion.col(3 + axis) = Eigen::Vector3d::Unit(axis).cross(x);
  return motion;
}

struct Part {
  std::vector<Eigen::Index> nodes;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double size = 0.0;

  Part(const mesh::Mesh& mesh, std::vector<Eigen::Index> given) : nodes(std::move(given)) {
    const Eigen::MatrixX3d x = mesh.nodes()(nodes, Eigen::all);
    centre = x.colwise().mean().transpose();
    size = (x.rowwise() - centre.transpose()).rowwise().norm().maxCoeff();
  }
  [[nodiscard]] Motion motion(const mesh::Mesh& mesh, Eigen::Index node) const {
    return rigid_motion((mesh.nodes().row(node).transpose() - centre) / size);
  }
};

// Combinations (6 × k) of the rigid motions of a part that its supports leave free.
Eigen::MatrixXd free_motions(const mesh::Mesh& mesh, const DofMap& dofs, const Part& part) {
  Eigen::Matrix<double, 6, 6> held = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Index n_held = 0;
  for (const Eigen::Index node : part.nodes) {
    if (dofs.solver_node(node) >= 0) continue;
    const Motion motion = part.motion(mesh, node);
    held += motion.transpose() * motion;
    ++n_held;
  }
  if (n_held == 0) return Eigen::MatrixXd::Identity(6, 6);
  const SymmetricPairs eigen = symmetric_pairs(held / double(n_held));
  // Squares of lever arms over the size of the part: 1e-12 is a support of 1e-6 of that size.
  const auto n_free = static_cast<Eigen::Index>((eigen.values.array() < 1e-12).count());
  return eigen.vectors.leftCols(n_free);
}

std::vector<Part> parts_of(const mesh::Mesh& mesh) {
  const std::vector<std::size_t> owner = part_of_node(mesh);
  std::vector<std::vector<Eigen::Index>> members(owner.size());
  for (std::size_t node = 0; node < owner.size(); ++node) {
    members[owner[node]].push_back(static_cast<Eigen::Index>(node));
  }
  std::vector<Part> parts;
  for (auto& nodes : members) {
    if (!nodes.empty()) parts.emplace_back(mesh, std::move(nodes));
  }
  return parts;
}

}  // namespace

Eigen::MatrixXd rigid_body_modes(const mesh::Mesh& mesh, const FeSystem& system) {
  const DofMap& dofs = system.dofs;
  Eigen::MatrixXd modes(dofs.n_local_dofs(), 0);
  for (const Part& part : parts_of(mesh)) {
    const Eigen::MatrixXd free = free_motions(mesh, dofs, part);
    if (free.cols() == 0) continue;
    const Eigen::Index before = modes.cols();
    modes.conservativeResize(Eigen::NoChange, before + free.cols());
    modes.rightCols(free.cols()).setZero();
    for (const Eigen::Index node : part.nodes) {
      const Eigen::Index at = dofs.solver_node(node);
      if (at < dofs.first() || at >= dofs.last()) continue;
      modes.block(3 * (at - dofs.first()), before, 3, free.cols()) = part.motion(mesh, node) * free;
    }
  }
  return modes.cols() == 0 ? modes : mass_orthonormal(system.mass_matrix.get(), modes);
}

double elastic_scale(const Eigen::MatrixX3d& nodes, const FeSystem& system, Eigen::Index n_rigid) {
  const DofMap& dofs = system.dofs;
  const Eigen::RowVector3d lower = nodes.colwise().minCoeff();
  const Eigen::RowVector3d upper = nodes.colwise().maxCoeff();
  const double size = (upper - lower).maxCoeff();
  Eigen::MatrixXd fields = Eigen::MatrixXd::Zero(dofs.n_local_dofs(), 30);
  for (Eigen::Index i = dofs.first(); i < dofs.last(); ++i) {
    const Eigen::Vector3d x =
        (nodes.row(dofs.mesh_node(i)) - 0.5 * (lower + upper)).transpose() / size;
    Eigen::Vector<double, 10> monomials;
    monomials << 1.0, x[0], x[1], x[2], x[0] * x[0], x[1] * x[1], x[2] * x[2], x[0] * x[1],
        x[1] * x[2], x[2] * x[0];
    for (int d = 0; d < 3; ++d)
      fields.block(3 * (i - dofs.first()) + d, 10 * d, 1, 10) = monomials.transpose();
  }
  const Eigen::MatrixXd MF = multiply(system.mass_matrix.get(), fields);
  const Eigen::MatrixXd gram = inner_products(fields, MF);
  const SymmetricPairs metric = symmetric_pairs(gram);
  // A mesh of a few nodes cannot tell all fields apart: keep the directions that differ.
  const double floor = 1e-10 * metric.values.maxCoeff();
  const auto n_kept = static_cast<Eigen::Index>((metric.values.array() > floor).count());
  const Eigen::MatrixXd to_orthonormal =
      metric.vectors.rightCols(n_kept) *
      metric.values.tail(n_kept).cwiseSqrt().cwiseInverse().asDiagonal();
  const Eigen::MatrixXd energy = inner_products(fields, multiply(system.stiffness.get(), fields));
  const SymmetricPairs ritz = symmetric_pairs(to_orthonormal.transpose() * energy * to_orthonormal);
  // A mechanism inside the body may be one of the fields: its zero is no scale. Values of bodies a
  // hundred times as long as thick span eight decades.
  const double zero = 1e-10 * ritz.values[n_kept - 1];
  Eigen::Index first = std::min(n_rigid, n_kept - 1);
  while (first + 1 < n_kept && ritz.values[first] < zero) ++first;
  return ritz.values[first];
}

}  // namespace microslip::fem
