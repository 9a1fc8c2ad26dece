#include "pipelines/structure/structure_stage.hpp"

#include <algorithm>
#include <new>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "fem/petsc_error.hpp"
#include "fem/ranks.hpp"
#include "fem/slepc_session.hpp"
#include "mesh/count_text.hpp"
#include "mesh/mesh_error.hpp"
#include "mesh/mesh_reader.hpp"
#include "mesh/mesher_process.hpp"
#include "mesh/refined_mesh.hpp"
#include "pipelines/import/given_matrices.hpp"
#include "pipelines/import/matrix_checks.hpp"
#include "pipelines/import/mesh_file.hpp"
#include "pipelines/import/mesher_limits.hpp"
#include "pipelines/import/named_points.hpp"
#include "pipelines/import/step_mesh.hpp"
#include "pipelines/model/contact_frame.hpp"
#include "pipelines/model/contact_preload.hpp"
#include "pipelines/model/nodal_load.hpp"
#include "pipelines/structure/geometry_bytes.hpp"
#include "pipelines/structure/given_modes.hpp"
#include "pipelines/structure/on_all_ranks.hpp"
#include "pipelines/structure/solver_memory.hpp"
#include "pipelines/structure/solver_time.hpp"
#include "pipelines/structure/static_preload.hpp"
#include "pipelines/structure/structure_members.hpp"
#include "pipelines/system/machine.hpp"
#include "pipelines/system/output_file.hpp"
#include "pipelines/system/result_cache.hpp"
#include "pipelines/system/scene_error.hpp"
#include "pipelines/system/sealed_bytes.hpp"
#include "pipelines/text/nearest_name.hpp"

namespace microslip::pipelines {
namespace {

/// The name that may be meant, as a question; "": none is near, or the mesh has that very name.
std::string similar_name(const mesh::Mesh& mesh, const std::string& name) {
  std::vector<std::string> names = mesh.surface_names();
  for (std::string& set : mesh.node_set_names()) names.push_back(std::move(set));
  if (std::ranges::find(names, name) != names.end()) return {};
  const std::string near =
      nearest_name(name, std::vector<std::string_view>(names.begin(), names.end()));
  return near.empty() ? "" : fmt::format("; did you mean \"{}\"?", near);
}

/// Looks a name of the scene up in the mesh.
/// @throws SceneError  it is not there: where it was asked for.
template <typename LookUp>
void require_name(const mesh::Mesh& mesh, const std::string& place, const std::string& name,
                  const LookUp& look_up) {
  try {
    static_cast<void>(look_up(name));
  } catch (const mesh::MeshError& error) {
    throw SceneError(place + ": " + error.what() + similar_name(mesh, name));
  }
}

/// Meshes the geometry of a scene.
void make_mesh(const SceneDescription& scene, const std::filesystem::path& mesh_file) {
  if (const auto* step = std::get_if<StepModel>(&scene.model)) {
    mesh_step_model(*step, mesh_file);
  } else {
    const auto& blade = std::get<BladeModel>(scene.model);
    with_mesher([&](const mesh::MesherLimits& limits) {
      mesh::mesh_blade(blade.geometry, blade.sizes, mesh_file, limits);
    });
  }
}

mesh::Mesh mesh_of(const SceneDescription& scene, const std::filesystem::path& mesh_file) {
  if (const auto* given = std::get_if<MeshFileModel>(&scene.model)) return read_mesh(*given);
  if (ResultCache* cache = ResultCache::in_use()) {
    const ResultCache::Entry entry = cache->entry("mesh", geometry_of(scene));
    if (const auto made = entry.find()) {
      write_whole(mesh_file, *made);
    } else {
      make_mesh(scene, mesh_file);
      entry.keep(bytes_of(mesh_file));
    }
  } else {
    make_mesh(scene, mesh_file);
  }
  return mesh::read_gmsh(mesh_file);
}

/// The contacts as their static shapes see them. A stiffness matters where the degree is chosen by
/// it.
TaskFace face_of(const mesh::Mesh& mesh, const ContactDescription& contact,
                 const BasisSettings& basis) {
  TaskFace face{mesh.surface(contact.surface), face_frame(mesh, contact), Eigen::Vector3d::Zero()};
  if (basis.residual != ResidualKind::attachment) return face;
  if (!contact.tangential_stiffness || !contact.normal_stiffness) {
    throw SceneError(contact.place +
                     ": attachment shapes need a stiffness of the contact in N/m^3");
  }
  if (basis.attachment_degree) return face;
  const double tangential = *contact.tangential_stiffness;
  face.local_stiffness = {tangential, *contact.normal_stiffness, tangential};
  return face;
}

StructureTask task_of(const mesh::Mesh& mesh, const SceneDescription& scene) {
  StructureTask task{mesh, scene.clamped, scene.material, {}, {}, scene.settings.basis, {}, {}};
  if (given_matrices(scene) != nullptr) {
    task.matrices = matrices_of(mesh, scene);
    task.clamped.clear();
  }
  if (scene.rotation && scene.rotation->speed > 0.0) task.rotation = scene.rotation;
  if (task.basis.residual == ResidualKind::none) return task;
  for (const ContactDescription& contact : scene.contacts) {
    task.faces.push_back(face_of(mesh, contact, task.basis));
  }
  if (task.basis.residual == ResidualKind::attachment && !task.faces.empty()) {
    task.forces = loads_as_shapes(excitation_loads(mesh, scene.forces));
  }
  return task;
}

/// What is not held moves along three axes; of matrices what has an entry on the diagonal.
Eigen::Index n_free(const StructureTask& task) {
  if (task.matrices) return (task.matrices->stiffness.diagonal().array() != 0.0).count();
  std::set<Eigen::Index> held;
  for (const std::string& name : task.clamped) {
    const std::vector<Eigen::Index> nodes = task.mesh.node_set(name);
    held.insert(nodes.begin(), nodes.end());
  }
  return 3 * (task.mesh.n_nodes() - static_cast<Eigen::Index>(held.size()));
}

void require_count(const StructureTask& task, const SceneDescription& scene) {
  const Eigen::Index most = n_free(task);
  if (task.basis.n_modes <= most) return;
  throw SceneError(
      fmt::format("{}: {} modes are asked for, and what is not held has {} degrees of freedom; ask "
                  "for fewer",
                  place_in(scene, "modes.count"), task.basis.n_modes, most));
}

/// Instead of the direct one it was to be solved by.
bool has_iterative_way(const StructureTask& task) {
  return task.basis.solver == fem::SolverKind::direct && !task.rotation;
}

StructureModes solve_on_all_ranks(const StructureTask& task, const SceneDescription& scene) {
  require_count(task, scene);
  require_memory(task.mesh, task.basis.solver);
  require_time(task.mesh, task.basis);
  StructureModes modes;
  try {
    on_all_ranks(
        modes_work, [&] { return bytes_of(task); }, [&] { modes = solve(task); });
  } catch (const fem::MemoryError& error) {
    if (!has_iterative_way(task)) throw;
    throw fem::MemoryError(with_iterative_way(error.what()));
  } catch (const std::bad_alloc&) {
    if (!has_iterative_way(task)) throw;
    throw fem::MemoryError(with_iterative_way("out of memory"));
  }
  return modes;
}

StructureModes modes_in(const std::string& kept) {
  StructureModes modes;
  ByteReader reader(kept);
  reader(modes);
  modes.timings = {};
  return modes;
}

StructureModes solved(const StructureTask& task, const SolvedElsewhere& by) {
  ResultCache* cache = ResultCache::in_use();
  if (cache == nullptr) return by.solve(task);
  const ResultCache::Entry entry = cache->entry("modes", bytes_of(task) + by.arithmetic);
  if (const auto made = entry.find()) return modes_in(*made);
  StructureModes modes = by.solve(task);
  ByteWriter bytes;
  bytes(modes);
  entry.keep(bytes.bytes());
  return modes;
}

/// A factorisation and a solution for each node of the contact.
/// @param rotated  as StructureModes has it.
contact::ElasticFace kept_static_face(const mesh::Mesh& mesh, const SceneDescription& scene,
                                      const Eigen::VectorXd& rotated) {
  ResultCache* cache = ResultCache::in_use();
  if (cache == nullptr) return static_face(mesh, scene, rotated);
  const ResultCache::Entry entry = cache->entry(
      "static", bytes_of(task_of(mesh, scene)) + static_inputs(mesh, scene) + arithmetic());
  contact::ElasticFace face;
  if (const auto made = entry.find()) {
    ByteReader reader(*made);
    reader(face);
    return face;
  }
  face = static_face(mesh, scene, rotated);
  ByteWriter bytes;
  bytes(face);
  entry.keep(bytes.bytes());
  return face;
}

StructureModes solved(const StructureTask& task, const SceneDescription& scene) {
  return solved(task, {arithmetic(),
                       [&](const StructureTask& own) { return solve_on_all_ranks(own, scene); }});
}

/// What the eigensolver finds wrong lies in the files.
StructureModes solved_from_matrices(const mesh::Mesh& mesh, const SceneDescription& scene) {
  const StructureTask task = task_of(mesh, scene);
  try {
    StructureModes modes = solved(task, scene);
    if (std::string question = mass_question(mesh, *task.matrices); !question.empty()) {
      modes.warnings.push_back(std::move(question));
    }
    return modes;
  } catch (const fem::EigenError& error) {
    const MatrixFiles& files = *given_matrices(scene);
    throw fem::EigenError(
        fmt::format("{}; of given matrices that is most often a stiffness that is not positive "
                    "definite: look in "
                    "{} for an entry that is lost, of the wrong sign or size, and whether {} is of "
                    "the same model",
                    error.what(), files.stiffness.string(), files.mass.string()));
  }
}

/// What there is to name in a scene, or how names come into a file.
std::string surfaces_text(const mesh::Mesh& mesh) {
  const std::vector<std::string> names = mesh.surface_names();
  if (!names.empty()) return fmt::format("surfaces: {}", fmt::join(names, ", "));
  if (!mesh.node_set_names().empty()) return "surfaces: none";
  return "surfaces: none: what is held and what rubs needs a name in the file (gmsh: Physical "
         "Surface(\"root\") = {1}; other codes: share/doc/meshes.md); force and output may stand "
         "at coordinates";
}

/// Points that have coordinates stay the nodes that the mesh of the file has there.
mesh::Mesh with_other_elements(mesh::Mesh mesh, const SceneDescription& scene) {
  const auto* file = std::get_if<MeshFileModel>(&scene.model);
  if (file == nullptr) return mesh;
  if (file->midside_nodes) mesh = mesh::quadratic(mesh);
  for (int i = 0; i < file->refinement; ++i) {
    require_memory_when_cut(mesh, scene.settings.basis.solver);
    mesh = mesh::refined(mesh);
  }
  return mesh;
}

}  // namespace

mesh::Mesh obtain_mesh(const SceneDescription& scene, const std::filesystem::path& mesh_file) {
  mesh::Mesh mesh = mesh_of(scene, mesh_file);
  name_points(mesh, scene);
  return with_other_elements(std::move(mesh), scene);
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
      "mesh: {} nodes, {}, volume {:.6g} m^3{}\n"
      "bounding box: x {:.6g} to {:.6g}, y {:.6g} to {:.6g}, z {:.6g} to {:.6g} m\n"
      "{}",
      mesh.n_nodes(), mesh::counted(mesh.n_elements(), "element", "elements"), mesh.volume(),
      density > 0.0 ? fmt::format(", mass {:.6g} kg", density * mesh.volume()) : "", lower.x(),
      upper.x(), lower.y(), upper.y(), lower.z(), upper.z(), surfaces_text(mesh));
  const auto sets = mesh.node_set_names();
  if (!sets.empty()) text += fmt::format("\npoints and node sets: {}", fmt::join(sets, ", "));
  if (mesh.n_loose_nodes() > 0) {
    const bool is_one = mesh.n_loose_nodes() == 1;
    text += fmt::format("\n{} to no volume element and {} left out",
                        mesh::counted(mesh.n_loose_nodes(), "node belongs", "nodes belong"),
                        is_one ? "is" : "are");
  }
  return text;
}

void check_names(const mesh::Mesh& mesh, const SceneDescription& scene) {
  const auto nodes = [&](const std::string& name) { return mesh.node_set(name); };
  const auto faces = [&](const std::string& name) { return mesh.surface(name); };
  for (const std::string& name : scene.clamped) {
    require_name(mesh, scene.clamped_place, name, nodes);
  }
  for (const ForceDescription& force : scene.forces) {
    require_name(mesh, force.place, force.at, nodes);
  }
  for (const ForceDescription& force : scene.static_loads.forces) {
    require_name(mesh, force.place, force.at, nodes);
  }
  for (const PressureDescription& entry : scene.static_loads.pressures) {
    require_name(mesh, entry.place, entry.surface, faces);
  }
  if (scene.response) {
    require_name(mesh, scene.response->output.place, scene.response->output.at, nodes);
  }
  for (const ContactDescription& contact : scene.contacts) {
    require_name(mesh, contact.place, contact.surface, faces);
  }
  require_frames(mesh, scene);
  require_preload(mesh, scene);
}

std::string arithmetic() {
  const Machine machine = describe_machine();
  std::string text =
      fmt::format("{}, {} threads, {} ranks", machine.blas, machine.blas_threads, fem::n_ranks());
  for (const auto& [name, version] : fem::library_versions()) {
    text += fmt::format(", {} {}", name, version);
  }
  return text;
}

StructureModes solve_structure(const mesh::Mesh& mesh, const SceneDescription& scene,
                               const SolvedElsewhere& elsewhere) {
  const StructureTask task = task_of(mesh, scene);
  require_count(task, scene);
  return solved(task, elsewhere);
}

StructureModes solve_structure(const mesh::Mesh& mesh, const SceneDescription& scene) {
  if (given_modes(scene) != nullptr) return given_structure(mesh, scene);
  try {
    StructureModes modes = given_matrices(scene) != nullptr ? solved_from_matrices(mesh, scene)
                                                            : solved(task_of(mesh, scene), scene);
    if (has_static_preload(scene)) modes.static_face = kept_static_face(mesh, scene, modes.rotated);
    return modes;
  } catch (const fem::EigenError& error) {
    if (!std::string_view(error.what()).starts_with("rotation: ")) throw;
    throw fem::EigenError(fmt::format("{}: {}", place_in(scene, "static.speed"), error.what()));
  }
}

std::optional<StructureModes> kept_structure(const mesh::Mesh& mesh,
                                             const SceneDescription& scene) {
  const ResultCache* cache = ResultCache::in_use();
  if (cache == nullptr || given_modes(scene) != nullptr) return std::nullopt;
  const auto kept = cache->kept("modes", bytes_of(task_of(mesh, scene)) + arithmetic());
  if (!kept) return std::nullopt;
  StructureModes modes = modes_in(*kept);
  if (has_static_preload(scene)) modes.static_face = kept_static_face(mesh, scene, modes.rotated);
  return modes;
}

}  // namespace microslip::pipelines
