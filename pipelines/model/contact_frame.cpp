#include "pipelines/model/contact_frame.hpp"

#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "mesh/surface.hpp"
#include "pipelines/system/scene_error.hpp"
#include "pipelines/text/effect_table.hpp"

namespace microslip::pipelines {
namespace {

constexpr double least_sine_in_a_plane = 1e-6;
// Nearer to the normal p turns round within a cell, and there is no slip direction to speak of.
constexpr double least_sine_at_a_place = 0.1;

mesh::SurfacePlane plane_of(const mesh::Mesh& mesh, const ContactDescription& contact) {
  return mesh::fit_plane(mesh.nodes(), mesh.surface(contact.surface));
}

double off_plane(const mesh::SurfacePlane& plane) { return plane.flatness / plane.diameter; }

bool has_local_frames(const mesh::SurfacePlane& plane, const ContactDescription& contact) {
  if (contact.local_frames) return *contact.local_frames && off_plane(plane) > plane_to_rounding;
  return off_plane(plane) > effect_row("local_frames").threshold;
}

/// Sine of the angle between two directions.
double sine_between(const Eigen::Vector3d& normal, const Eigen::Vector3d& direction) {
  return (direction - normal * normal.dot(direction)).norm() / direction.norm();
}

Eigen::Vector3d any_direction_in_plane(const Eigen::Vector3d& normal) {
  Eigen::Index least = 0;
  normal.cwiseAbs().minCoeff(&least);
  return Eigen::Vector3d::Unit(least);
}

void refuse_slip_along_normal(const ContactDescription& contact, const Eigen::Vector3d& q) {
  throw SceneError(
      fmt::format("{}: it is along the normal ({:.3g}, {:.3g}, {:.3g}) of \"{}\"; "
                  "give a direction with a part in the plane",
                  contact.slip_place, q.x(), q.y(), q.z(), contact.surface));
}

void require_slip_direction(const mesh::Mesh& mesh, const ContactDescription& contact) {
  const SteepestPlace worst = steepest_place(mesh, contact);
  if (worst.sine >= least_sine_at_a_place) return;
  const Eigen::Vector3d& x = worst.place;
  const Eigen::Vector3d& q = worst.normal;
  throw SceneError(fmt::format(
      "{}: it is along the normal ({:.3g}, {:.3g}, {:.3g}) of \"{}\" at "
      "({:.6g}, {:.6g}, {:.6g}) m, to {:.1f} degrees: the curved face has no slip direction there; "
      "give a direction that no place of it faces, or name a part of the face",
      contact.slip_place, q.x(), q.y(), q.z(), contact.surface, x.x(), x.y(), x.z(),
      std::asin(worst.sine) * 180.0 / std::numbers::pi));
}

/// What knows one plane alone.
void require_no_plane(const ContactDescription& contact, const PatchSettings& settings) {
  const char* key = settings.fit == PatchSettings::Fit::degree       ? "fit"
                    : contact.preload_moment != std::array{0.0, 0.0} ? "preload_moment"
                                                                     : nullptr;
  if (key == nullptr) return;
  throw SceneError(
      fmt::format("{}: {}.{} is of a plane face, \"{}\" is curved and has axes at every place: "
                  "leave it out, or "
                  "have the face taken as plane by effects.local_frames = \"off\"",
                  contact.place, contact.key, key, contact.surface));
}

}  // namespace

double off_plane(const mesh::Mesh& mesh, const ContactDescription& contact) {
  return off_plane(plane_of(mesh, contact));
}

bool has_local_frames(const mesh::Mesh& mesh, const ContactDescription& contact) {
  return has_local_frames(plane_of(mesh, contact), contact);
}

Eigen::Matrix3d contact_frame(const mesh::Mesh& mesh, const ContactDescription& contact) {
  const mesh::SurfacePlane plane = plane_of(mesh, contact);
  const Eigen::Vector3d q = plane.normal;
  if (sine_between(q, contact.slip_direction) >= least_sine_in_a_plane) {
    return mesh::axes_at(q, contact.slip_direction);
  }
  if (!has_local_frames(plane, contact)) refuse_slip_along_normal(contact, q);
  return mesh::axes_at(q, any_direction_in_plane(q));
}

mesh::FaceFrame face_frame(const mesh::Mesh& mesh, const ContactDescription& contact) {
  const Eigen::Matrix3d frame = contact_frame(mesh, contact);
  if (!has_local_frames(mesh, contact)) return {frame};
  return {frame, contact.slip_direction};
}

PlaneCoordinates in_plane(const Eigen::MatrixX3d& points, const Eigen::Vector3d& origin,
                          const Eigen::Matrix3d& frame) {
  const Eigen::MatrixX3d local = points.rowwise() - origin.transpose();
  return {local * frame.row(0).transpose(), local * frame.row(2).transpose()};
}

SteepestPlace steepest_place(const mesh::Mesh& mesh, const ContactDescription& contact) {
  const mesh::SurfacePlane plane = plane_of(mesh, contact);
  SteepestPlace worst{sine_between(plane.normal, contact.slip_direction), plane.centroid,
                      plane.normal};
  if (!has_local_frames(plane, contact)) return worst;
  constexpr int enough = 1000;  // some 3 degrees from one to the next on half a sphere
  const mesh::SurfaceSampling places =
      mesh::sample_surface(mesh.nodes(), mesh.surface(contact.surface), enough);
  worst.sine = 2.0;
  for (const auto& [points, normals] : {std::pair{&places.centres, &places.centre_normals},
                                        std::pair{&places.vertices, &places.vertex_normals}}) {
    for (Eigen::Index i = 0; i < points->rows(); ++i) {
      const Eigen::Vector3d normal = normals->row(i);
      const double sine = sine_between(normal, contact.slip_direction);
      if (sine < worst.sine) worst = {sine, points->row(i), normal};
    }
  }
  return worst;
}

void require_frames(const mesh::Mesh& mesh, const SceneDescription& scene) {
  for (std::size_t i = 0; i < scene.contacts.size(); ++i) {
    const ContactDescription& contact = scene.contacts[i];
    if (!face_frame(mesh, contact).is_local()) continue;
    require_slip_direction(mesh, contact);
    require_no_plane(contact, scene.settings.patches[i]);
  }
}

}  // namespace microslip::pipelines
