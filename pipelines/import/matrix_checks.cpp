#include "pipelines/import/matrix_checks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "pipelines/system/scene_error.hpp"

namespace microslip::pipelines {
namespace {

using Sparse = Eigen::SparseMatrix<double, Eigen::RowMajor>;

constexpr double force_tolerance = 1e-2;  // of what the motion of a row's neighbours makes
constexpr double mass_tolerance = 0.05;   // condensed parts and added masses differ by direction
constexpr double most_rows = 0.5;         // condensed parts and foundations hold fewer
constexpr double turned_rows =
    0.05;  // of a fine mesh: inside a body no strain that is uniform makes a force
constexpr Eigen::Index fewest_rows = 12;  // to judge by
constexpr std::array<const char*, 3> axes{"x", "y", "z"};

bool is_free(const Sparse& matrix, Eigen::Index dof) {
  return matrix.outerIndexPtr()[dof + 1] > matrix.outerIndexPtr()[dof];
}

bool is_free_node(const Sparse& matrix, Eigen::Index node) {
  return is_free(matrix, 3 * node) && is_free(matrix, 3 * node + 1) &&
         is_free(matrix, 3 * node + 2);
}

/// Lumped masses of quadratic elements may be 0 at their corners.
bool is_massless(const Sparse& mass, Eigen::Index dof) {
  for (Sparse::InnerIterator entry(mass, dof); entry; ++entry) {
    if (entry.value() != 0.0) return false;
  }
  return true;
}

void check_diagonal(const mesh::Mesh& mesh, const Sparse& matrix, const Sparse& other,
                    bool is_stiffness, const std::filesystem::path& file) {
  for (Eigen::Index dof = 0; dof < matrix.rows(); ++dof) {
    if (!is_free(matrix, dof) && !is_free(other, dof)) continue;
    const double value = matrix.coeff(dof, dof);
    if (value > 0.0 || (!is_stiffness && is_massless(matrix, dof))) continue;
    const auto x = mesh.nodes().row(dof / 3);
    throw SceneError(fmt::format(
        "{}: the diagonal entry of u{} of the node at ({:.6g}, {:.6g}, {:.6g}) m is {:g}; "
        "stiffness and mass of a motion "
        "are above 0: is the file damaged, or another matrix?",
        file.string(), axes[static_cast<std::size_t>(dof % 3)], x[0], x[1], x[2], value));
  }
}

/// Degrees of freedom of nodes that share no element with one that is held.
std::vector<Eigen::Index> far_from_supports(const mesh::Mesh& mesh, const Sparse& K) {
  std::vector<bool> near(static_cast<std::size_t>(mesh.n_nodes()));
  for (const mesh::ElementBlock& block : mesh.elements()) {
    for (const auto& element : block.connectivity.rowwise()) {
      const bool is_held =
          std::ranges::any_of(element, [&](Eigen::Index node) { return !is_free_node(K, node); });
      if (!is_held) continue;
      for (const Eigen::Index node : element) near[static_cast<std::size_t>(node)] = true;
    }
  }
  std::vector<Eigen::Index> dofs;
  for (Eigen::Index dof = 0; dof < K.rows(); ++dof) {
    if (!near[static_cast<std::size_t>(dof / 3)]) dofs.push_back(dof);
  }
  return dofs;
}

Eigen::VectorXd rotation(const mesh::Mesh& mesh, Eigen::Index axis) {
  const Eigen::RowVector3d centre = mesh.nodes().colwise().mean();
  Eigen::VectorXd motion(3 * mesh.n_nodes());
  for (Eigen::Index i = 0; i < mesh.n_nodes(); ++i) {
    const Eigen::Vector3d arm = mesh.nodes().row(i) - centre;
    motion.segment<3>(3 * i) = Eigen::Vector3d::Unit(axis).cross(arm);
  }
  return motion;
}

/// Σ K_ij t_j against Σ |K_ij| |t_j|.
bool resists(const Sparse& K, Eigen::Index dof, const Eigen::VectorXd& motion) {
  double force = 0.0;
  double scale = 0.0;
  for (Sparse::InnerIterator entry(K, dof); entry; ++entry) {
    force += entry.value() * motion[entry.col()];
    scale += std::abs(entry.value() * motion[entry.col()]);
  }
  return std::abs(force) > force_tolerance * scale;
}

/// The same beside the motion of the node itself, so that it does not matter how far the axis is.
bool resists_beside_its_own(const Sparse& K, Eigen::Index dof, const Eigen::VectorXd& motion) {
  const Eigen::Vector3d own = motion.segment<3>(dof - dof % 3);
  double force = 0.0;
  double scale = 0.0;
  for (Sparse::InnerIterator entry(K, dof); entry; ++entry) {
    const double relative = motion[entry.col()] - own[entry.col() % 3];
    force += entry.value() * relative;
    scale += std::abs(entry.value() * relative);
  }
  return std::abs(force) > force_tolerance * scale;
}

/// Those of `dofs` that resist none of the translations.
std::vector<Eigen::Index> moved_without_force(const Sparse& K,
                                              const std::vector<Eigen::Index>& dofs) {
  std::vector<Eigen::Index> free = dofs;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const Eigen::VectorXd moved = Eigen::Vector3d::Unit(axis).replicate(K.rows() / 3, 1);
    std::erase_if(free, [&](Eigen::Index dof) { return resists(K, dof, moved); });
  }
  return free;
}

/// Mass along x, y and z of the displacements that count [kg].
template <typename Counts>
Eigen::Vector3d masses(const Sparse& M, const Counts& counts) {
  Eigen::Vector3d mass = Eigen::Vector3d::Zero();
  for (Eigen::Index dof = 0; dof < M.rows(); ++dof) {
    if (!counts(dof)) continue;
    for (Sparse::InnerIterator entry(M, dof); entry; ++entry) {
      if (entry.col() % 3 == dof % 3 && counts(entry.col())) mass[dof % 3] += entry.value();
    }
  }
  return mass;
}

/// Of the nodes that are free in every direction in which any is.
void check_masses(const Sparse& M, const MatrixSources& sources) {
  std::array<bool, 3> moves{};
  for (Eigen::Index dof = 0; dof < M.rows(); ++dof) {
    moves[static_cast<std::size_t>(dof % 3)] |= is_free(M, dof);
  }
  Eigen::Vector3d mass = masses(M, [&](Eigen::Index dof) {
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      if (moves[static_cast<std::size_t>(axis)] && !is_free(M, dof - dof % 3 + axis)) return false;
    }
    return true;
  });
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    if (!moves[static_cast<std::size_t>(axis)])
      mass[axis] = mass.maxCoeff();  // held: nothing tells
  }
  if (mass.maxCoeff() - mass.minCoeff() <= mass_tolerance * mass.maxCoeff()) return;
  throw SceneError(fmt::format(
      "{}: the mass of all free nodes is {:.6g} kg along x, {:.6g} along y, {:.6g} along z; "
      "expected "
      "one mass: do ux, uy, uz in {} stand for these directions, is {} the mass of this body?",
      sources.nodes.string(), mass.x(), mass.y(), mass.z(), sources.nodes.filename().string(),
      sources.mass.filename().string()));
}

void check_stiffness(const mesh::Mesh& mesh, const Sparse& K, const MatrixSources& sources,
                     const std::vector<Eigen::Index>& far, const std::vector<Eigen::Index>& free) {
  const auto n_far = static_cast<double>(far.size());
  if (static_cast<double>(free.size()) < (1.0 - most_rows) * n_far) {
    throw SceneError(fmt::format(
        "{}: with {} forces act on {} of {} displacements far from what is held when the body is "
        "moved as a whole: do the rows in ux, uy, uz belong to these nodes, is {} a stiffness?",
        sources.nodes.string(), sources.stiffness.filename().string(), far.size() - free.size(),
        far.size(), sources.stiffness.filename().string()));
  }
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const Eigen::VectorXd turned = rotation(mesh, axis);
    const auto n = std::ranges::count_if(
        free, [&](Eigen::Index dof) { return resists_beside_its_own(K, dof, turned); });
    if (static_cast<double>(n) <= turned_rows * static_cast<double>(free.size())) continue;
    throw SceneError(fmt::format(
        "{}: with {} forces act on {} of {} displacements far from what is held when the body is "
        "turned as a whole about {}: do ux, uy, uz stand for the directions of x, y, z?",
        sources.nodes.string(), sources.stiffness.filename().string(), n, free.size(),
        axes[static_cast<std::size_t>(axis)]));
  }
}

}  // namespace

void check_matrices(const mesh::Mesh& mesh, const fem::GivenMatrices& matrices,
                    const MatrixSources& sources) {
  const Sparse& K = matrices.stiffness;
  const Sparse& M = matrices.mass;
  check_diagonal(mesh, K, M, true, sources.stiffness);
  check_diagonal(mesh, M, K, false, sources.mass);
  const std::vector<Eigen::Index> far = far_from_supports(mesh, K);
  if (std::ssize(far) < fewest_rows) return;
  const std::vector<Eigen::Index> free = moved_without_force(K, far);
  if (free.empty() && moved_without_force(M, far).size() == far.size()) {
    throw SceneError(
        fmt::format("{}: a body that is moved as a whole meets forces of this stiffness and none "
                    "of the mass {}: "
                    "are stiffness and mass exchanged?",
                    sources.stiffness.string(), sources.mass.filename().string()));
  }
  check_masses(M, sources);
  check_stiffness(mesh, K, sources, far, free);
}

double free_mass(const fem::GivenMatrices& matrices) {
  const Sparse& M = matrices.mass;
  return masses(M, [&](Eigen::Index dof) { return is_free(M, dof); }).maxCoeff();
}

std::string mass_question(const mesh::Mesh& mesh, const fem::GivenMatrices& matrices) {
  constexpr double least = 100.0;  // kg/m³; of what is held no mass is given
  constexpr double most = 30000.0;
  const double mass = free_mass(matrices);
  const double density = mass / mesh.volume();
  if (density >= least && density <= most) return {};
  return fmt::format(
      "model.mass_unit: what is free to move has {:.3g} kg in {:.3g} m^3 of the mesh, {:.3g} "
      "kg/m^3; "
      "usual is {:g} to {:g}: is the mass matrix in another unit, or length_unit wrong?",
      mass, mesh.volume(), density, least, most);
}

}  // namespace microslip::pipelines
