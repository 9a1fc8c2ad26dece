#include "pipelines/model/structure_stage.hpp"

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "mesh/mesh_error.hpp"
#include "mesh/mesh_reader.hpp"
#include "mesh/mesher_process.hpp"
#include "pipelines/model/contact_stage.hpp"
#include "pipelines/model/given_matrices.hpp"
#include "pipelines/model/given_modes.hpp"
#include "pipelines/model/mesh_file.hpp"
#include "pipelines/model/mesher_limits.hpp"
#include "pipelines/model/named_points.hpp"
#include "pipelines/model/nodal_load.hpp"
#include "pipelines/model/preload_shape.hpp"
#include "pipelines/model/step_mesh.hpp"
#include "pipelines/system/scene_error.hpp"

namespace microslip::pipelines {
namespace {

Eigen::MatrixXd nonzero_columns(const Eigen::MatrixXd& columns) {
  std::vector<Eigen::Index> kept;
  for (Eigen::Index j = 0; j < columns.cols(); ++j) {
    if (columns.col(j).squaredNorm() > 0.0) kept.push_back(j);
  }
  return columns(Eigen::all, kept);
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
void attach(fem::Structure& structure, const mesh::Mesh& mesh, const SceneDescription& scene,
            StructureModes& result) {
  fem::AttachmentOptions options;
  options.degree = scene.settings.basis.attachment_degree;
  std::vector<fem::AttachmentFace> faces;
  for (const ContactDescription& contact : scene.contacts) {
    if (!contact.tangential_stiffness || !contact.normal_stiffness) {
      throw SceneError(contact.place +
                       ": attachment shapes need a stiffness of the contact in N/m^3");
    }
    const double tangential = *contact.tangential_stiffness;
    const Eigen::Vector3d local(tangential, *contact.normal_stiffness, tangential);
    faces.push_back({mesh.surface(contact.surface), contact_frame(mesh, contact), local});
  }
  fem::AttachedBasis attached = structure.attach(
      result.basis, faces, nonzero_columns(excitation_loads(mesh, scene.forces)), options);
  result.attachment_text = attachment_text(attached);
  result.basis = std::move(attached.basis);
  result.richer = std::move(attached.richer);
}

/// Looks a name of the scene up in the mesh. @throws SceneError  it is not there: where it was asked for.
template <typename LookUp>
void require_name(const std::string& place, const LookUp& look_up) {
  try {
    static_cast<void>(look_up());
  } catch (const mesh::MeshError& error) {
    throw SceneError(place + ": " + error.what());
  }
}

/// From the body at rest to small motions about its equilibrium as it rotates.
void rotate(fem::Structure& structure, const mesh::Mesh& mesh, const SceneDescription& scene,
            StructureModes& result) {
  const fem::Rotation& rotation = *scene.rotation;
  const Eigen::VectorXd u = structure.rotate(mesh, scene.material, rotation);
  result.notes.push_back(
      fmt::format("rotating at {:.6g} rpm: the static displacement is at most {:.3g} m; modes are "
                  "those about it",
                  30.0 * rotation.speed / std::numbers::pi,
                  u.reshaped(3, mesh.n_nodes()).colwise().norm().maxCoeff()));
}

mesh::Mesh mesh_of(const SceneDescription& scene, const std::filesystem::path& mesh_file) {
  if (const auto* given = std::get_if<MeshFileModel>(&scene.model)) return read_mesh(*given);
  if (const auto* step = std::get_if<StepModel>(&scene.model)) {
    mesh_step_model(*step, mesh_file);
  } else {
    const auto& blade = std::get<BladeModel>(scene.model);
    with_mesher([&](const mesh::MesherLimits& limits) {
      mesh::mesh_blade(blade.geometry, blade.element_size, mesh_file, limits);
    });
  }
  return mesh::read_gmsh(mesh_file);
}

}  // namespace

mesh::Mesh obtain_mesh(const SceneDescription& scene, const std::filesystem::path& mesh_file) {
  mesh::Mesh mesh = mesh_of(scene, mesh_file);
  name_points(mesh, scene);
  return mesh;
}

mesh::Mesh reread_mesh(const SceneDescription& scene, const std::filesystem::path& mesh_file) {
  if (!element_size_of(scene)) return obtain_mesh(scene, mesh_file);
  mesh::Mesh mesh = mesh::read_gmsh(mesh_file);
  name_points(mesh, scene);
  return mesh;
}

std::string describe_mesh(const mesh::Mesh& mesh, double density) {
  const Eigen::Vector3d lower = mesh.lower();
  const Eigen::Vector3d upper = mesh.upper();
  std::string text = fmt::format(
      "mesh: {} nodes, {} elements, volume {:.6g} m^3{}\n"
      "bounding box: x {:.6g} to {:.6g}, y {:.6g} to {:.6g}, z {:.6g} to {:.6g} m\n"
      "surfaces: {}",
      mesh.n_nodes(), mesh.n_elements(), mesh.volume(),
      density > 0.0 ? fmt::format(", mass {:.6g} kg", density * mesh.volume()) : "", lower.x(),
      upper.x(), lower.y(), upper.y(), lower.z(), upper.z(), fmt::join(mesh.surface_names(), ", "));
  const auto sets = mesh.node_set_names();
  if (!sets.empty()) text += fmt::format("\npoints and node sets: {}", fmt::join(sets, ", "));
  if (mesh.n_loose_nodes() > 0) {
    text += fmt::format("\n{} nodes belong to no volume element and are left out",
                        mesh.n_loose_nodes());
  }
  return text;
}

void check_names(const mesh::Mesh& mesh, const SceneDescription& scene) {
  for (const std::string& name : scene.clamped) {
    require_name(scene.clamped_place, [&] { return mesh.node_set(name); });
  }
  for (const ForceDescription& force : scene.forces) {
    require_name(force.place, [&] { return mesh.node_set(force.at); });
  }
  if (scene.response) {
    const OutputDescription& output = scene.response->output;
    require_name(output.place, [&] { return mesh.node_set(output.at); });
  }
  for (const ContactDescription& contact : scene.contacts) {
    require_name(contact.place, [&] { return mesh.surface(contact.surface); });
    static_cast<void>(contact_frame(mesh, contact));
  }
  require_preload(mesh, scene);
}

StructureModes solve_structure(const mesh::Mesh& mesh, const SceneDescription& scene) {
  if (given_modes(scene) != nullptr) return given_structure(mesh, scene);
  fem::Structure structure = given_matrices(scene) != nullptr
                                 ? fem::Structure(mesh, matrices_of(mesh, scene))
                                 : fem::Structure(mesh, scene.material, scene.clamped);
  StructureModes result;
  result.n_dofs = structure.n_dofs();
  result.mass = structure.mass();
  if (scene.rotation && scene.rotation->speed > 0.0) rotate(structure, mesh, scene, result);
  fem::ModalOptions options;
  options.n_modes = scene.settings.basis.n_modes;
  result.basis = structure.solve_modes(options);
  if (scene.settings.basis.residual == ResidualKind::stiffness) {
    for (const ContactDescription& contact : scene.contacts) {
      result.residuals.push_back(structure.residual_flexibility(
          result.basis, mesh.surface(contact.surface), contact_frame(mesh, contact)));
    }
  }
  if (!scene.contacts.empty() && scene.settings.basis.residual == ResidualKind::attachment) {
    attach(structure, mesh, scene, result);
  }
  result.timings = structure.timings();
  return result;
}

}  // namespace microslip::pipelines
