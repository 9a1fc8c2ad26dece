#include "pipelines/structure/static_preload.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "fem/petsc_error.hpp"
#include "fem/ranks.hpp"
#include "fem/surface_load.hpp"
#include "mesh/surface.hpp"
#include "pipelines/import/given_matrices.hpp"
#include "pipelines/model/contact_frame.hpp"
#include "pipelines/model/contact_stage.hpp"
#include "pipelines/model/nodal_load.hpp"
#include "pipelines/structure/solver_memory.hpp"
#include "pipelines/system/byte_archive.hpp"
#include "pipelines/system/scene_error.hpp"

namespace microslip::pipelines {
namespace {

/// The freedoms of all contact faces: of plane ones along the normal, of curved ones, whose points
/// have normals of their own, along x, y and z.
struct FaceFreedoms {
  std::vector<Eigen::Index> nodes;
  std::vector<Eigen::RowVector3d> directions;

  [[nodiscard]] Eigen::Index size() const { return std::ssize(nodes); }

  /// Displacements along them, of columns over the mesh.
  [[nodiscard]] Eigen::MatrixXd of(const Eigen::MatrixXd& u) const {
    Eigen::MatrixXd v(size(), u.cols());
    for (Eigen::Index i = 0; i < v.rows(); ++i) {
      const auto k = static_cast<std::size_t>(i);
      v.row(i) = directions[k] * u.middleRows<3>(3 * nodes[k]);
    }
    return v;
  }
};

/// A row for each freedom of a node.
Eigen::MatrixX3d directions_of(const mesh::FaceFrame& frame) {
  if (frame.is_local()) return Eigen::Matrix3d::Identity();
  return frame.plane.row(1);
}

FaceFreedoms face_freedoms(const mesh::Mesh& mesh, const SceneDescription& scene) {
  FaceFreedoms freedoms;
  for (const ContactDescription& contact : scene.contacts) {
    const Eigen::MatrixX3d directions = directions_of(face_frame(mesh, contact));
    for (const Eigen::Index node : mesh.surface(contact.surface).nodes) {
      for (const auto& direction : directions.rowwise()) {
        freedoms.nodes.push_back(node);
        freedoms.directions.emplace_back(direction);
      }
    }
  }
  return freedoms;
}

Eigen::VectorXd load_of(const mesh::Mesh& mesh, const StaticLoads& loads) {
  Eigen::VectorXd load = excitation_loads(mesh, loads.forces).col(0);
  for (const PressureDescription& entry : loads.pressures) {
    load -= entry.pressure * fem::normal_traction(mesh.nodes(), mesh.surface(entry.surface));
  }
  return load;
}

Eigen::MatrixXd flexibility(fem::Structure& structure, const mesh::Mesh& mesh,
                            const FaceFreedoms& freedoms) {
  constexpr Eigen::Index at_once = 64;  // of the solutions, each as long as the mesh
  const Eigen::Index n = freedoms.size();
  Eigen::MatrixXd C(n, n);
  for (Eigen::Index begin = 0; begin < n; begin += at_once) {
    const Eigen::Index count = std::min(at_once, n - begin);
    Eigen::MatrixXd forces = Eigen::MatrixXd::Zero(3 * mesh.n_nodes(), count);
    for (Eigen::Index j = 0; j < count; ++j) {
      const auto k = static_cast<std::size_t>(begin + j);
      forces.block<3, 1>(3 * freedoms.nodes[k], j) = freedoms.directions[k].transpose();
    }
    C.middleCols(begin, count) = freedoms.of(structure.solve_static(forces));
  }
  return 0.5 * (C + C.transpose());
}

/// Places of a contact at rest: approach [m] and pressure [Pa].
struct RestingPlaces {
  Eigen::VectorXd approach;
  Eigen::VectorXd pressure;
};

/// A contact at rest, at its points and at the vertices of its cells.
struct RestingPatch {
  mesh::SurfaceSampling sampling;
  Eigen::SparseMatrix<double> to_cells, to_vertices;  ///< approach of freedoms of the face
  RestingPlaces cells{};
  RestingPlaces vertices{};
};

/// Height 0: smooth.
contact::RoughSurface surface_of(const ContactDescription& contact) {
  return contact.rules.roughness.value_or(contact::RoughSurface::cubic(0.0));
}

/// Interpolation to places, along their normals where the freedoms of a node are three.
Eigen::SparseMatrix<double> approach_of(const Eigen::SparseMatrix<double>& to,
                                        const Eigen::MatrixX3d& normals, bool is_local) {
  if (!is_local) return to;
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index j = 0; j < to.outerSize(); ++j) {
    for (Eigen::SparseMatrix<double>::InnerIterator it(to, j); it; ++it) {
      for (Eigen::Index axis = 0; axis < 3; ++axis) {
        entries.emplace_back(static_cast<int>(it.row()), static_cast<int>(3 * it.col() + axis),
                             it.value() * normals(it.row(), axis));
      }
    }
  }
  Eigen::SparseMatrix<double> along_normals(to.rows(), 3 * to.cols());
  along_normals.setFromTriplets(entries.begin(), entries.end());
  return along_normals;
}

/// Points of all contacts on the freedoms of all of them.
contact::ContactLayer layer_of(const SceneDescription& scene,
                               const std::vector<RestingPatch>& patches, Eigen::Index n_freedoms) {
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::Index n_points = 0;
  Eigen::Index first_freedom = 0;
  for (const RestingPatch& patch : patches) {
    const Eigen::SparseMatrix<double>& to = patch.to_cells;
    for (Eigen::Index j = 0; j < to.outerSize(); ++j) {
      for (Eigen::SparseMatrix<double>::InnerIterator it(to, j); it; ++it) {
        entries.emplace_back(static_cast<int>(n_points + it.row()),
                             static_cast<int>(first_freedom + it.col()), it.value());
      }
    }
    n_points += to.rows();
    first_freedom += to.cols();
  }
  contact::ContactLayer layer{Eigen::SparseMatrix<double>(n_points, n_freedoms),
                              Eigen::VectorXd(n_points),
                              Eigen::VectorXd(n_points),
                              Eigen::VectorXd(n_points),
                              {}};
  layer.to_points.setFromTriplets(entries.begin(), entries.end());
  Eigen::Index begin = 0;
  for (std::size_t i = 0; i < patches.size(); ++i) {
    const Eigen::VectorXd& weights = patches[i].sampling.weights;
    layer.weights.segment(begin, weights.size()) = weights;
    const ContactDescription& contact = scene.contacts[i];
    layer.stiffness.segment(begin, weights.size()).setConstant(*contact.normal_stiffness);
    layer.gap.segment(begin, weights.size()).setConstant(contact.gap);
    layer.surfaces.insert(layer.surfaces.end(), static_cast<std::size_t>(weights.size()),
                          surface_of(contact));
    begin += weights.size();
  }
  return layer;
}

Eigen::VectorXd pressure_at(const Eigen::VectorXd& approach, const ContactDescription& contact) {
  const contact::RoughSurface surface = surface_of(contact);
  return approach.unaryExpr(
      [&](double a) { return *contact.normal_stiffness * surface.at(a).compression; });
}

std::vector<RestingPatch> patches_at_rest(const mesh::Mesh& mesh, const SceneDescription& scene,
                                          const contact::ElasticFace& face) {
  std::vector<RestingPatch> patches;
  for (std::size_t i = 0; i < scene.contacts.size(); ++i) {
    mesh::SurfaceSampling sampling = mesh::sample_surface(
        mesh.nodes(), mesh.surface(scene.contacts[i].surface), contact_points(scene.settings, i));
    const bool is_local = has_local_frames(mesh, scene.contacts[i]);
    RestingPatch& patch = patches.emplace_back();
    patch.to_cells = approach_of(sampling.to_centres, sampling.centre_normals, is_local);
    patch.to_vertices = approach_of(sampling.to_vertices, sampling.vertex_normals, is_local);
    patch.sampling = std::move(sampling);
  }
  const contact::ElasticRest rest = [&] {
    try {
      return contact::elastic_rest(face, layer_of(scene, patches, face.approach.size()));
    } catch (const std::runtime_error& error) {
      throw RefusedError(
          fmt::format("{}: {}", scene.contacts.front().static_preload_place, error.what()));
    }
  }();
  Eigen::Index first_freedom = 0;
  Eigen::Index first_point = 0;
  for (std::size_t i = 0; i < patches.size(); ++i) {
    RestingPatch& patch = patches[i];
    const mesh::SurfaceSampling& sampling = patch.sampling;
    const auto own = rest.displacement.segment(first_freedom, patch.to_vertices.cols());
    patch.cells = {rest.approach.segment(first_point, sampling.weights.size()),
                   rest.pressure.segment(first_point, sampling.weights.size())};
    patch.vertices.approach = (patch.to_vertices * own).array() - scene.contacts[i].gap;
    patch.vertices.pressure = pressure_at(patch.vertices.approach, scene.contacts[i]);
    first_freedom += own.size();
    first_point += sampling.weights.size();
  }
  return patches;
}

/// Of all contacts [N]. @throws RefusedError  nothing is pressed.
double total_force(const SceneDescription& scene, const std::vector<RestingPatch>& patches) {
  double total = 0.0;
  double nearest = -std::numeric_limits<double>::infinity();
  double between = nearest;  // the points
  for (const RestingPatch& patch : patches) {
    total += patch.sampling.weights.dot(patch.cells.pressure);
    nearest = std::max(nearest, patch.cells.approach.maxCoeff());
    between = std::max(between, patch.vertices.approach.maxCoeff());
  }
  if (total > 0.0) return total;
  if (between > 0.0) {
    throw RefusedError(fmt::format(
        "{}: the static loads press the contact between its points only, by {:.3g} m at most: take "
        "more of them (contact.points), or raise the loads",
        scene.contacts.front().static_preload_place, between));
  }
  throw RefusedError(fmt::format(
      "{}: the static loads press no contact: where it is nearest it stays {:.3g} m away; turn or "
      "raise the loads of [static] (a force acts on the blade, the contact is pressed along its "
      "outward normal q), or make contact.gap smaller",
      scene.contacts.front().static_preload_place, std::max(0.0, -nearest)));
}

/// n0' [Pa]: pressure, or −k_v times a gap with the stiffness the point has in motion.
Eigen::VectorXd rest_load(const RestingPlaces& places, const Eigen::VectorXd& point_stiffness) {
  return (places.pressure.array() > 0.0)
      .select(places.pressure, point_stiffness.cwiseProduct(places.approach));
}

/// The same everywhere [Pa]: what presses, spread over the face.
void set_uniform(const RestingPatch& resting, double unit, contact::Patch& patch) {
  const Eigen::VectorXd& weights = resting.sampling.weights;
  const double mean = weights.dot(resting.cells.pressure) / weights.sum();
  patch.cells.preload_field.setConstant(patch.cells.size(), unit * mean);
  patch.vertices.preload_field.setConstant(patch.vertices.size(), unit * mean);
}

/// Of all contacts, root mean square: deviation of the pressure from the mean of its face, over
/// that of all. What is closed and what is open count alike.
double pressure_variation(const std::vector<RestingPatch>& patches) {
  double deviation = 0.0;
  double force = 0.0;
  double area = 0.0;
  for (const RestingPatch& patch : patches) {
    const Eigen::VectorXd& weights = patch.sampling.weights;
    const double own = weights.dot(patch.cells.pressure);
    const Eigen::ArrayXd off = patch.cells.pressure.array() - own / weights.sum();
    deviation += weights.dot(off.square().matrix());
    force += own;
    area += weights.sum();
  }
  return std::sqrt(deviation / area) * area / force;
}

std::string line_of(const ContactDescription& contact, const RestingPatch& patch) {
  const Eigen::VectorXd& pressure = patch.cells.pressure;
  const Eigen::VectorXd& weights = patch.sampling.weights;
  std::string text =
      fmt::format("static preload {}: {:.6g} N, pressure {:.3g} to {:.3g} Pa", contact.name,
                  weights.dot(pressure), pressure.minCoeff(), pressure.maxCoeff());
  const double open =
      weights.dot((patch.cells.approach.array() <= 0.0).cast<double>().matrix()) / weights.sum();
  if (open == 0.0) return text + ", closed everywhere";
  return text + fmt::format(", {:.1f} % of the area open by up to {:.3g} m", 100.0 * open,
                            -patch.cells.approach.minCoeff());
}

}  // namespace

contact::ElasticFace static_face(fem::Structure& structure, const mesh::Mesh& mesh,
                                 const SceneDescription& scene, const Eigen::VectorXd& rotated) {
  const FaceFreedoms freedoms = face_freedoms(mesh, scene);
  contact::ElasticFace face;
  try {
    face.approach = freedoms.of(structure.solve_static(load_of(mesh, scene.static_loads)));
    face.flexibility = flexibility(structure, mesh, freedoms);
  } catch (const fem::EigenError& error) {
    const char* remedy = given_matrices(scene) != nullptr
                             ? "matrices of a body that is held are needed"
                             : "hold the body by supports.clamped";
    throw RefusedError(fmt::format("{}: no static solution: {}; {}",
                                   scene.contacts.front().static_preload_place, error.what(),
                                   remedy));
  }
  if (rotated.size() > 0) face.approach += freedoms.of(rotated);
  return face;
}

void set_static_preload(ReducedModel& model, const mesh::Mesh& mesh, const SceneDescription& scene,
                        const contact::ElasticFace& face) {
  const std::vector<RestingPatch> patches = patches_at_rest(mesh, scene, face);
  const double total = total_force(scene, patches);
  model.static_preload = total;
  model.static_variation = pressure_variation(patches);
  // A patch that is open has gaps and no share of the force: patches share a load evenly, their
  // preload does not.
  const double unit = static_cast<double>(patches.size()) / total;
  for (std::size_t i = 0; i < patches.size(); ++i) {
    contact::Patch& patch = model.patches[i];
    patch.load_share = 1.0;
    if (scene.uniform_static_preload || !scene.areas) {
      set_uniform(patches[i], unit, patch);
      continue;
    }
    patch.cells.preload_field = unit * rest_load(patches[i].cells, patch.cells.stiffness.col(1));
    patch.vertices.preload_field =
        unit * rest_load(patches[i].vertices, patch.vertices.stiffness.col(1));
  }
}

std::vector<std::string> static_preload_questions(const ReducedModel& model,
                                                  const SceneDescription& scene) {
  constexpr Eigen::Index few = 10;
  constexpr double strongest = 3e9;  // [Pa]
  Eigen::Index n_closed = 0;
  Eigen::Index n_points = 0;
  double area = 0.0;  // closed
  for (const contact::Patch& patch : model.patches) {
    const Eigen::ArrayXd closed = (patch.cells.preload_field.array() > 0.0).cast<double>();
    n_closed += static_cast<Eigen::Index>(closed.sum());
    n_points += closed.size();
    area += closed.matrix().dot(patch.cells.weights);
  }
  const std::string& place = scene.contacts.front().static_preload_place;
  std::vector<std::string> questions;
  if (n_closed < few && n_closed < n_points) {
    questions.push_back(fmt::format(
        "{}: the static loads press {} of {} contact points: force and area of so few are no more "
        "than a size; take more of them (contact.points)",
        place, n_closed, n_points));
  }
  if (const double mean = *model.static_preload / area; mean > strongest) {
    questions.push_back(fmt::format(
        "{}: the static loads press with {:.2g} Pa in the mean of what is closed; usual is at most "
        "{:.2g} (yield of steels 3e8 to 2e9): are loads, speed and contact.gap in their units?",
        place, mean, strongest));
  }
  return questions;
}

std::string describe_static_preload(const mesh::Mesh& mesh, const SceneDescription& scene,
                                    const contact::ElasticFace& face) {
  const std::vector<RestingPatch> patches = patches_at_rest(mesh, scene, face);
  static_cast<void>(total_force(scene, patches));
  std::string text;
  for (std::size_t i = 0; i < patches.size(); ++i) {
    if (i > 0) text += '\n';
    text += line_of(scene.contacts[i], patches[i]);
  }
  return text;
}

contact::ElasticFace static_face(const mesh::Mesh& mesh, const SceneDescription& scene,
                                 Eigen::VectorXd rotated) {
  if (fem::n_ranks() > 1) {
    throw RefusedError("contact.preload = \"static\" is solved on one rank: start without mpirun");
  }
  const fem::SolverKind solver = scene.settings.basis.solver;
  require_memory(mesh, solver);
  fem::Structure structure =
      given_matrices(scene) != nullptr
          ? fem::Structure(mesh, matrices_of(mesh, scene), solver)
          : fem::Structure(mesh, scene.material, scene.clamped, fem::Tet10Rule::accurate, solver);
  if (scene.rotation && scene.rotation->speed > 0.0) {
    rotated = structure.rotate(mesh, scene.material, *scene.rotation, rotated);
  }
  return static_face(structure, mesh, scene, rotated);
}

std::string static_inputs(const mesh::Mesh& mesh, const SceneDescription& scene) {
  const FaceFreedoms freedoms = face_freedoms(mesh, scene);
  Eigen::MatrixXd rows(freedoms.size(), 4);
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    rows.row(i) << static_cast<double>(freedoms.nodes[k]), freedoms.directions[k];
  }
  ByteWriter bytes;
  bytes(load_of(mesh, scene.static_loads));
  bytes(rows);
  return std::string(bytes.bytes());
}

std::string describe_static_preload(const mesh::Mesh& mesh, const SceneDescription& scene) {
  return describe_static_preload(mesh, scene, static_face(mesh, scene));
}

}  // namespace microslip::pipelines
