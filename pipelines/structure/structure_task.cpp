#include "pipelines/structure/structure_task.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "pipelines/system/byte_archive.hpp"

// Structured bindings name every member: one that is added and not told does not compile.
namespace microslip {
using pipelines::Is;

namespace mesh {
auto members(Is<ElementBlock> auto& value) {
  auto& [type, connectivity, tags] = value;
  return std::tie(type, connectivity, tags);
}
auto members(Is<FaceBlock> auto& value) {
  auto& [type, connectivity] = value;
  return std::tie(type, connectivity);
}
auto members(Is<Surface> auto& value) {
  auto& [name, faces, nodes, area] = value;
  static_cast<void>(name);
  return std::tie(faces, nodes, area);
}
auto members(Is<FaceFrame> auto& value) {
  auto& [plane, slip_direction] = value;
  return std::tie(plane, slip_direction);
}
}  // namespace mesh

namespace fem {
auto members(Is<Material> auto& value) {
  auto& [youngs_modulus, poissons_ratio, density] = value;
  return std::tie(youngs_modulus, poissons_ratio, density);
}
auto members(Is<Rotation> auto& value) {
  auto& [speed, origin, direction] = value;
  return std::tie(speed, origin, direction);
}
auto members(Is<GivenMatrices> auto& value) {
  auto& [stiffness, mass] = value;
  return std::tie(stiffness, mass);
}
}  // namespace fem

namespace pipelines {
auto members(Is<BasisSettings> auto& value) {
  auto& [n_modes, reach, residual, attachment_degree, solver] = value;
  return std::tie(n_modes, reach, residual, attachment_degree, solver);
}
auto members(Is<TaskFace> auto& value) {
  auto& [surface, frame, local_stiffness] = value;
  return std::tie(surface, frame, local_stiffness);
}
auto members(Is<StructureTask> auto& value) {
  auto& [mesh, clamped, material, matrices, rotation, basis, faces, forces] = value;
  static_cast<void>(mesh);  // without their names: see bytes_of()
  static_cast<void>(clamped);
  return std::tie(material, matrices, rotation, basis, faces, forces);
}

namespace {

constexpr const char* held = "held";

std::vector<Eigen::Index> held_nodes(const StructureTask& task) {
  std::vector<Eigen::Index> nodes;
  for (const std::string& name : task.clamped) {
    const std::vector<Eigen::Index> more = task.mesh.node_set(name);
    nodes.insert(nodes.end(), more.begin(), more.end());
  }
  std::ranges::sort(nodes);
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

std::string attachment_text(const fem::AttachedBasis& attached) {
  const fem::ModalBasis& basis = attached.basis;
  if (basis.n_attachment == 0) return "attachment: the modes leave nothing out";
  std::string text = fmt::format(
      "attachment: {} static shapes of tractions up to degree {} and of the forces, from {:.6g} Hz "
      "to {:.6g} Hz",
      basis.n_attachment, attached.degree,
      basis.frequency[basis.n_free()] / (2.0 * std::numbers::pi),
      basis.frequency[basis.frequency.size() - 1] / (2.0 * std::numbers::pi));
  if (attached.n_dropped > 0)
    text += fmt::format("; {} that depend on others left out", attached.n_dropped);
  if (std::isfinite(attached.missed_share)) {
    text += fmt::format("; tractions of degree {} miss at most {:.2g} % of their flexibility",
                        attached.degree + 1, 100.0 * attached.missed_share);
  }
  return text;
}

/// Attachment shapes of the contacts and of the forces behind the modes.
void attach(fem::Structure& structure, const StructureTask& task, StructureModes& result) {
  fem::AttachmentOptions options;
  options.degree = task.basis.attachment_degree;
  std::vector<fem::AttachmentFace> faces;
  for (const TaskFace& face : task.faces) {
    faces.push_back({face.surface, face.frame, face.local_stiffness});
  }
  fem::AttachedBasis attached = structure.attach(result.basis, faces, task.forces, options);
  result.attachment_text = attachment_text(attached);
  result.basis = std::move(attached.basis);
  result.richer = std::move(attached.richer);
}

/// From the body at rest to small motions about its equilibrium as it rotates.
void rotate(fem::Structure& structure, const StructureTask& task, StructureModes& result) {
  const Eigen::VectorXd u = structure.rotate(task.mesh, task.material, *task.rotation);
  result.notes.push_back(
      fmt::format("rotating at {:.6g} rpm: the static displacement is at most {:.3g} m; modes are "
                  "those about it",
                  30.0 * task.rotation->speed / std::numbers::pi,
                  u.reshaped(3, task.mesh.n_nodes()).colwise().norm().maxCoeff()));
  result.rotated = u;
}

/// As many as are asked for, and about as many more as reach the frequency asked for.
fem::ModalBasis modes_that_reach(fem::Structure& structure, const BasisSettings& asked,
                                 fem::ModalOptions options) {
  constexpr double growth = 1.5;  // of their number with the frequency, at most
  constexpr int most = 4;         // times those asked for
  options.n_modes = asked.n_modes;
  fem::ModalBasis basis = structure.solve_modes(options);
  const double top = basis.frequency[basis.frequency.size() - 1];
  if (!(top < asked.reach)) return basis;
  const double enough = std::ceil(asked.n_modes * std::pow(asked.reach / top, growth));
  const double bound =
      std::min<double>(most * asked.n_modes, static_cast<double>(structure.n_dofs()));
  options.n_modes = static_cast<Eigen::Index>(std::min(enough, bound));
  return structure.solve_modes(options);
}

/// Modes and what stands for the others.
void find_modes(fem::Structure& structure, const StructureTask& task, fem::CountTime count,
                StructureModes& result) {
  fem::ModalOptions options;
  options.count = count;
  result.basis = modes_that_reach(structure, task.basis, options);
  result.residuals.clear();
  if (task.basis.residual == ResidualKind::stiffness) {
    for (const TaskFace& face : task.faces) {
      result.residuals.push_back(
          structure.residual_flexibility(result.basis, face.surface, face.frame));
    }
  }
  if (!task.faces.empty() && task.basis.residual == ResidualKind::attachment) {
    attach(structure, task, result);
  }
}

/// False: some were missed.
bool count_modes(fem::Structure& structure, StructureModes& result) {
  const std::optional<Eigen::Index> count = structure.count_modes();
  if (!count) return false;
  result.basis.inertia_count = *count;
  if (result.richer) result.richer->basis.inertia_count = *count;
  return true;
}

}  // namespace

Eigen::MatrixXd loads_as_shapes(const Eigen::MatrixXd& loads) {
  constexpr double steps = 0x1p40;  // far above rounding, far below what a shape feels
  std::vector<Eigen::Index> kept;
  Eigen::MatrixXd shapes = loads;
  for (Eigen::Index j = 0; j < loads.cols(); ++j) {
    const double largest = loads.col(j).cwiseAbs().maxCoeff();
    if (!(largest > 0.0)) continue;
    kept.push_back(j);
    shapes.col(j) = (loads.col(j).array() * (steps / largest)).round() / steps;
  }
  return shapes(Eigen::all, kept);
}

std::string bytes_of(const StructureTask& task) {
  ByteWriter bytes;
  bytes(task.mesh.nodes());
  bytes(task.mesh.elements());
  bytes(held_nodes(task));
  bytes(task);
  return bytes.bytes();
}

StructureTask structure_task(std::string_view bytes) {
  ByteReader reader(bytes);
  Eigen::MatrixX3d nodes;
  std::vector<mesh::ElementBlock> elements;
  std::vector<Eigen::Index> held_nodes;
  reader(nodes);
  reader(elements);
  reader(held_nodes);
  StructureTask task{
      mesh::Mesh(std::move(nodes), std::move(elements), {}, {{held, std::move(held_nodes)}}),
      {held},
      {},
      {},
      {},
      {},
      {},
      {}};
  reader(task);
  return task;
}

StructureModes solve(const StructureTask& task) {
  const fem::SolverKind solver = task.basis.solver;
  fem::Structure structure = task.matrices ? fem::Structure(task.mesh, *task.matrices, solver)
                                           : fem::Structure(task.mesh, task.material, task.clamped,
                                                            fem::Tet10Rule::accurate, solver);
  StructureModes result;
  result.n_dofs = structure.n_dofs();
  result.mass = structure.mass();
  if (task.rotation) rotate(structure, task, result);
  find_modes(structure, task, fem::CountTime::at_the_end, result);
  if (!count_modes(structure, result)) {
    find_modes(structure, task, fem::CountTime::at_once, result);
  }
  if (result.basis.n_free() > task.basis.n_modes) {
    result.notes.push_back(fmt::format(
        "modes: {} in place of {}: harmonics are to be chosen closely, and reach up to {:.4g} Hz",
        result.basis.n_free(), task.basis.n_modes, task.basis.reach / (2.0 * std::numbers::pi)));
  }
  result.timings = structure.timings();
  return result;
}

}  // namespace pipelines
}  // namespace microslip
