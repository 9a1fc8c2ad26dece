#include "pipelines/model/contact_stage.hpp"

#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "pipelines/description/damping_ratios.hpp"
#include "pipelines/model/contact_frame.hpp"
#include "pipelines/model/contact_preload.hpp"
#include "pipelines/model/middle_point.hpp"
#include "pipelines/model/nodal_load.hpp"
#include "pipelines/model/patch_shapes.hpp"
#include "pipelines/system/scene_error.hpp"

namespace microslip::pipelines {
namespace {

constexpr double flatness_told = 1e-3;  // of the diameter: gaps between real faces are micrometres
constexpr double angle_limit_rad =
    5.0 * std::numbers::pi / 180.0;                  // warn: local frames would differ
constexpr double fold_rad = 0.5 * std::numbers::pi;  // beyond, a face lies over itself in its plane

void set_excitation(ReducedModel& model, const mesh::Mesh& mesh, const SceneDescription& scene,
                    const Eigen::MatrixXd& shapes) {
  const Eigen::MatrixX2d modal = shapes.transpose() * excitation_loads(mesh, scene.forces);
  model.force_sine = modal.col(0);
  model.force_cosine = modal.col(1);
  model.force_static = Eigen::VectorXd::Zero(shapes.cols());
}

/// Row sums along p, q and r of places, n × 3 [m³/N].
Eigen::MatrixX3d residual_at(const fem::ResidualFlexibility& residual,
                             const Eigen::SparseMatrix<double>& to,
                             const contact::PatchSamples& samples) {
  if (samples.normals.rows() == 0) return to * residual.row_sums;
  const Eigen::MatrixXd moved = to * residual.displacements;
  Eigen::MatrixX3d sums(to.rows(), 3);
  for (Eigen::Index i = 0; i < sums.rows(); ++i) {
    const Eigen::RowVector3d p = samples.slip_directions.row(i);
    const Eigen::RowVector3d q = samples.normals.row(i);
    const auto along_axis = [&](Eigen::Index axis, const Eigen::RowVector3d& direction) {
      return direction.dot(moved.block<1, 3>(i, 3 * axis));
    };
    sums.row(i) << along_axis(0, p), along_axis(1, q), along_axis(2, p.cross(q));
  }
  return sums;
}

void set_stiffness(contact::Patch& patch, const ContactDescription& contact,
                   const mesh::SurfaceSampling& sampling,
                   const fem::ResidualFlexibility* residual) {
  if (residual == nullptr && (!contact.normal_stiffness || !contact.tangential_stiffness)) {
    throw RefusedError(
        contact.place + ": " + contact.key +
        ": \"rigid\" means the residual stiffness alone, and modes.residual = \"none\" leaves "
        "none; give a local stiffness in N/m^3");
  }
  const auto set = [&](contact::PatchSamples& samples, const Eigen::SparseMatrix<double>& to) {
    const Eigen::MatrixX3d more = residual != nullptr ? residual_at(*residual, to, samples)
                                                      : Eigen::MatrixX3d::Zero(to.rows(), 3);
    samples.stiffness.resize(to.rows(), 3);
    for (int axis = 0; axis < 3; ++axis) {
      const auto& local = axis == 1 ? contact.normal_stiffness : contact.tangential_stiffness;
      samples.stiffness.col(axis) =
          series_stiffness(local, more.col(axis), axis == 1 ? "normal" : "tangential", axis != 2);
    }
    if (residual != nullptr) samples.compliance = more;
  };
  try {
    set(patch.cells, sampling.to_centres);
    set(patch.vertices, sampling.to_vertices);
  } catch (const RefusedError& error) {
    throw RefusedError(contact.place + ": " + error.what());
  }
}

/// Friction coefficient and preload field over the patch, in p and r from its centroid.
void set_fields(contact::Patch& patch, const ContactDescription& contact) {
  const Eigen::Vector3d origin = contact::centroid(patch);
  const auto centres = in_plane(patch.cells.points, origin, patch.frame);
  const auto vertices = in_plane(patch.vertices.points, origin, patch.frame);
  patch.cells.friction = contact.friction.at(centres.p, centres.r);
  patch.vertices.friction = contact.friction.at(vertices.p, vertices.r);
  if (contact.preload_moment != std::array{0.0, 0.0}) {
    patch.tilted_areas.push_back(
        {contact.key + ".preload_moment", 0, centres.p, centres.r, 1.0, contact.preload_moment});
  }
  patch.cells.preload_field = preload_field_of(contact, centres.p, centres.r, patch.cells.weights);
  if (!contact.preload_field) {
    patch.vertices.preload_field =
        Eigen::VectorXd::Constant(vertices.p.size(), 1.0 / patch.cells.weights.sum());
    return;
  }
  const Field field(*contact.preload_field);
  const Eigen::VectorXd shape = field.at(centres.p, centres.r);
  Eigen::Index largest = 0;
  shape.cwiseAbs().maxCoeff(&largest);
  patch.vertices.preload_field =
      field.at(vertices.p, vertices.r) * (patch.cells.preload_field[largest] / shape[largest]);
}

/// Rough surfaces change their part of the stiffness alone: it must be known.
contact::SurfaceRules rules_of(const ContactDescription& contact) {
  contact::SurfaceRules rules = contact.rules;
  if (!rules.roughness) return rules;
  rules.local_tangential_stiffness = contact.tangential_stiffness;
  rules.local_normal_stiffness = contact.normal_stiffness;
  if (!rules.local_tangential_stiffness || !rules.local_normal_stiffness) {
    throw RefusedError(
        contact.place + ": " + contact.key +
        ".roughness: rough surfaces need a stiffness of full contact; give normal_stiffness and "
        "tangential_stiffness in N/m^3 instead of \"rigid\"");
  }
  return rules;
}

contact::Patch patch_of(const mesh::Mesh& mesh, const ContactDescription& contact,
                        const PatchSettings& settings, int n_points, const fem::ModalBasis& basis,
                        const fem::ResidualFlexibility* residual) {
  const mesh::Surface& surface = mesh.surface(contact.surface);
  const mesh::SurfaceSampling sampling = mesh::sample_surface(mesh.nodes(), surface, n_points);
  contact::Patch patch;
  patch.name = contact.name;
  const mesh::FaceFrame frame = face_frame(mesh, contact);
  patch.frame = frame.plane;
  patch.off_plane = off_plane(mesh, contact);
  patch.cells.points = sampling.centres;
  patch.cells.weights = sampling.weights;
  patch.vertices.points = sampling.vertices;
  patch.connectivity = sampling.cells;
  patch.load_share = contact.preload_share.value_or(sampling.weights.sum());
  patch.wear_coefficient = contact.wear_coefficient;
  patch.rules = rules_of(contact);
  set_shapes(patch, {mesh, surface, sampling, frame}, settings, basis.shapes);
  set_stiffness(patch, contact, sampling, residual);
  set_fields(patch, contact);
  return patch;
}

void warn_of_the_plane(const mesh::SurfacePlane& plane, const ContactDescription& contact,
                       std::vector<std::string>& warnings) {
  if (plane.largest_angle > angle_limit_rad) {
    warnings.push_back(fmt::format(
        "contact surface \"{}\": facet normals turn by up to {:.1f} degrees; one plane is used",
        contact.surface, plane.largest_angle * 180.0 / std::numbers::pi));
  }
  if (plane.flatness > flatness_told * plane.diameter) {
    warnings.push_back(
        fmt::format("contact surface \"{}\": nodes are up to {:.3g} m off the mean plane ({:.2g} % "
                    "of its size); the "
                    "patch is simulated as plane, with the preload as given",
                    contact.surface, plane.flatness, 100.0 * plane.flatness / plane.diameter));
  }
}

void warn_of_the_fit(const contact::Patch& patch, const mesh::Mesh& mesh,
                     const ContactDescription& contact, Eigen::Index n_modes,
                     std::vector<std::string>& warnings) {
  const auto plane = mesh::fit_plane(mesh.nodes(), mesh.surface(contact.surface));
  if (patch.cells.normals.rows() == 0) {
    warn_of_the_plane(plane, contact, warnings);
  } else if (plane.largest_angle > fold_rad) {
    warnings.push_back(fmt::format(
        "contact surface \"{}\": normals turn by up to {:.0f} degrees from their mean, so that the "
        "face lies over itself in its mean plane; static shapes and fields in p and r do not tell "
        "the sides apart: name parts of the face, or take more modes",
        contact.surface, plane.largest_angle * 180.0 / std::numbers::pi));
  }
  if (is_fit_poor(patch)) {
    Eigen::Index mode = 0;
    const double worst = patch.fit_error.maxCoeff(&mode);
    const bool is_static = mode >= n_modes;
    warnings.push_back(fmt::format(
        "fit-poor: the fitted field of {} {} of \"{}\" errs by {:.1f} % on the patch{}",
        is_static ? "static shape" : "mode", is_static ? mode + 1 - n_modes : mode + 1,
        contact.surface, 100.0 * worst,
        patch.fit_degree < 0 ? ": its elements are interpolated instead"
                             : fmt::format(" (degree {}); contact.fit = \"none\" interpolates "
                                           "instead, as \"auto\" would",
                                           patch.fit_degree)));
  }
}

}  // namespace

Eigen::VectorXd series_stiffness(const std::optional<double>& local,
                                 const Eigen::VectorXd& residual, const char* direction,
                                 bool refuse) {
  const double local_flexibility = local ? (*local > 0.0 ? 1.0 / *local : 0.0) : 0.0;
  if (local && *local == 0.0) return Eigen::VectorXd::Zero(residual.size());
  const Eigen::ArrayXd flexibility = residual.array() + local_flexibility;
  const Eigen::Index n_bad = (flexibility <= 0.0).count();
  if (n_bad > 0 && refuse) {
    throw RefusedError(fmt::format(
        "residual flexibility makes the {} contact stiffness not positive at {} of {} points "
        "(smallest 1/k_local + c = {:.3g} m^3/N): give a finite local stiffness and modes.residual "
        "= "
        "\"attachment\", or more modes",
        direction, n_bad, residual.size(), flexibility.minCoeff()));
  }
  return flexibility.inverse();
}

ReducedModel reduce_to_contact(const mesh::Mesh& mesh, const SceneDescription& scene,
                               const fem::ModalBasis& basis,
                               const std::vector<fem::ResidualFlexibility>& residuals,
                               std::vector<std::string>& warnings) {
  ReducedModel model;
  model.frequency = basis.frequency;
  model.n_attachment = basis.n_attachment;
  model.damping_ratio = damping_ratios(scene.modes, basis.frequency, basis.n_attachment);
  set_excitation(model, mesh, scene, basis.shapes);
  model.output = Eigen::VectorXd::Zero(basis.frequency.size());
  if (scene.response) {
    const OutputDescription& output = scene.response->output;
    model.output = basis.shapes.transpose() * unit_load(mesh, output.at, output.direction);
  }
  for (std::size_t i = 0; i < scene.contacts.size(); ++i) {
    const ContactDescription& contact = scene.contacts[i];
    model.patches.push_back(patch_of(mesh, contact, scene.settings.patches[i],
                                     contact_points(scene.settings, i), basis,
                                     residuals.empty() ? nullptr : &residuals[i]));
    warn_of_the_fit(model.patches.back(), mesh, contact,
                    model.frequency.size() - model.n_attachment, warnings);
    if (!scene.areas) model.patches.back() = at_middle_point(std::move(model.patches.back()));
  }
  return model;
}

ReducedModel reduced_model(const SceneDescription& scene) {
  const auto& modal = std::get<ModalModel>(scene.model);
  ReducedModel model;
  model.frequency = 2.0 * std::numbers::pi * modal.frequency_hz;
  model.n_attachment = modal.n_attachment;
  model.damping_ratio = modal.damping_ratio;
  model.force_sine = modal.force_sine;
  model.force_cosine = modal.force_cosine;
  model.force_static = modal.force_static;
  model.output = modal.output;
  if (modal.points.empty()) return model;
  contact::Patch& patch = model.patches.emplace_back();
  patch.name = "contact";
  patch.load_measure = modal.load_measure;
  patch.rules = scene.rules;
  patch.wear_coefficient = scene.wear_coefficient;
  patch.tilted_areas = modal.tilted_areas;
  const auto n = static_cast<Eigen::Index>(modal.points.size());
  contact::PatchSamples& cells = patch.cells;
  cells.weights = modal.weights;
  cells.shapes = modal.shapes;
  cells.compliance = modal.compliance;
  cells.points = Eigen::MatrixX3d::Zero(n, 3);
  if (modal.positions.rows() == n) {
    cells.points.col(0) = modal.positions.col(0);  // frame is the identity: p, q, r are x, y, z
    cells.points.col(2) = modal.positions.col(1);
  }
  cells.stiffness.resize(n, 3);
  cells.friction.resize(n);
  cells.preload_field.resize(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const contact::PointParameters& point = modal.points[static_cast<std::size_t>(i)];
    cells.stiffness.row(i) << point.tangential_stiffness, point.normal_stiffness,
        point.tangential_stiffness;
    cells.friction[i] = point.friction_coefficient;
    cells.preload_field[i] = point.rest_load;
  }
  if (modal.second_stiffness.size() == n) cells.stiffness.col(2) = modal.second_stiffness;
  if (!scene.areas && modal.positions.rows() > 1) patch = at_middle_point(std::move(patch));
  return model;
}

}  // namespace microslip::pipelines
