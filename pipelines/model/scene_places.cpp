#include "pipelines/model/scene_places.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <variant>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "mesh/surface.hpp"
#include "pipelines/import/named_points.hpp"
#include "pipelines/import/step_mesh.hpp"
#include "pipelines/model/contact_frame.hpp"
#include "pipelines/model/contact_preload.hpp"
#include "pipelines/model/nodal_load.hpp"

namespace microslip::pipelines {
namespace {

bool is_surface(const mesh::Mesh& mesh, const std::string& name) {
  return std::ranges::count(mesh.surface_names(), name) > 0;
}

/// Where a surface and a node set have one name, supports hold the nodes of the set.
std::vector<Eigen::Index> nodes_of(const mesh::Mesh& mesh, PlaceRole role,
                                   const std::string& name) {
  const bool needs_faces = role == PlaceRole::contact || role == PlaceRole::pressure;
  const bool takes_surface = needs_faces || (role != PlaceRole::clamped && is_surface(mesh, name));
  return takes_surface ? mesh.surface(name).nodes : mesh.node_set(name);
}

/// A force that is the same at each node of a set, an output that is their mean:
/// no faces weigh there.
bool lies_by_its_nodes(const mesh::Mesh& mesh, PlaceRole role, const std::string& name) {
  if (!mesh.has_faces(name)) return true;
  const bool acts =
      role == PlaceRole::force || role == PlaceRole::output || role == PlaceRole::static_force;
  return acts && !is_spread(mesh, name);
}

ScenePlace place_of(const mesh::Mesh& mesh, PlaceRole role, const std::string& name) {
  ScenePlace place{.role = role, .name = name, .nodes = nodes_of(mesh, role, name), .centre = {}};
  if (mesh.has_faces(name)) place.area = mesh.surface(name).area;
  place.centre = lies_by_its_nodes(mesh, role, name)
                     ? Eigen::Vector3d(mesh.nodes()(place.nodes, Eigen::all).colwise().mean())
                     : mesh::fit_plane(mesh.nodes(), mesh.surface(name)).centroid;
  return place;
}

/// A length [m] or a component, for people: rounding errors of the mesh are no digits.
double rounded(double value) { return std::abs(value) < 1e-12 ? 0.0 : value; }

std::string vector_text(const Eigen::Vector3d& v) {
  return fmt::format("({:.4g}, {:.4g}, {:.4g})", rounded(v.x()), rounded(v.y()), rounded(v.z()));
}

std::string line_of(const ScenePlace& place) {
  std::string text = fmt::format("{} {}: ", name(place.role), place.name);
  if (!place.load.empty()) text += place.load + ' ';
  if (place.direction != Eigen::Vector3d::Zero() && place.role != PlaceRole::contact) {
    text += fmt::format("along {}, ", vector_text(place.direction));
  }
  const std::size_t n = place.nodes.size();
  text += fmt::format("{} node{}", n, n == 1 ? "" : "s");
  if (place.area > 0.0) text += fmt::format(", {:.4g} m^2", place.area);
  return text + fmt::format(" at {} m", vector_text(place.centre));
}

std::string preload_text(const PatchPreload& preload) {
  if (preload.gap_needs_modes) return preload.text + ": a gap, whose width follows from the modes";
  if (preload.text.empty()) return fmt::format("a gap of {:.3g} m", preload.gap);
  if (preload.gap > 0.0) return fmt::format("{}: a gap of {:.3g} m", preload.text, preload.gap);
  return fmt::format("{}: {:.3g} Pa", preload.text, preload.pressure);
}

void add_contact(const mesh::Mesh& mesh, const SceneDescription& scene, std::size_t index,
                 std::vector<std::string>& lines) {
  const ContactDescription& contact = scene.contacts[index];
  const Eigen::Matrix3d frame = contact_frame(mesh, contact);
  const auto plane = mesh::fit_plane(mesh.nodes(), mesh.surface(contact.surface));
  lines.back() += fmt::format(", flat to {:.2g} m", rounded(plane.flatness));
  lines.push_back(fmt::format("  p {} slip, q {} out of the body, r {}", vector_text(frame.row(0)),
                              vector_text(frame.row(1)), vector_text(frame.row(2))));
  if (has_local_frames(mesh, contact)) {
    lines.back() += fmt::format(
        "; every place has axes of its own, normals turn by up to {:.1f} degrees from q",
        plane.largest_angle * 180.0 / std::numbers::pi);
  }
  std::vector<std::string> preloads;
  for (const PatchPreload& preload : patch_preloads(mesh, scene, index)) {
    preloads.push_back(preload_text(preload));
  }
  if (!preloads.empty()) lines.push_back(fmt::format("  preload {}", fmt::join(preloads, "; ")));
}

/// Σ ∬ k_v dA of all contacts [N/m]; nothing where residual flexibility is a part of k_v.
std::optional<double> normal_stiffness(const mesh::Mesh& mesh, const SceneDescription& scene) {
  if (scene.settings.basis.residual == ResidualKind::stiffness) return std::nullopt;
  double sum = 0.0;
  for (const ContactDescription& contact : scene.contacts) {
    if (!contact.normal_stiffness) return std::nullopt;
    sum += *contact.normal_stiffness * mesh.surface(contact.surface).area;
  }
  return sum > 0.0 ? std::optional(sum) : std::nullopt;
}

}  // namespace

const char* name(PlaceRole role) {
  switch (role) {
    case PlaceRole::clamped:
      return "clamped";
    case PlaceRole::contact:
      return "contact";
    case PlaceRole::force:
      return "force";
    case PlaceRole::static_force:
      return "static force";
    case PlaceRole::pressure:
      return "pressure";
    case PlaceRole::output:
      break;
  }
  return "output";
}

std::vector<ScenePlace> scene_places(const mesh::Mesh& mesh, const SceneDescription& scene) {
  std::vector<ScenePlace> places;
  for (const std::string& name : scene.clamped) {
    places.push_back(place_of(mesh, PlaceRole::clamped, name));
  }
  for (const ForceDescription& force : scene.forces) {
    places.push_back(place_of(mesh, PlaceRole::force, force.at));
    places.back().direction = force.direction;
    places.back().load =
        fmt::format("{:g} N, phase {:g} degrees,", force.amplitude, force.phase_deg);
  }
  if (scene.response) {
    places.push_back(place_of(mesh, PlaceRole::output, scene.response->output.at));
    places.back().direction = scene.response->output.direction;
  }
  for (const ForceDescription& force : scene.static_loads.forces) {
    places.push_back(place_of(mesh, PlaceRole::static_force, force.at));
    places.back().direction = force.direction;
    places.back().load = fmt::format("{:g} N", force.amplitude);
  }
  for (const PressureDescription& entry : scene.static_loads.pressures) {
    places.push_back(place_of(mesh, PlaceRole::pressure, entry.surface));
    const double sign = entry.pressure < 0.0 ? 1.0 : -1.0;  // suction pulls outward
    places.back().direction =
        sign * mesh::fit_plane(mesh.nodes(), mesh.surface(entry.surface)).normal;
  }
  for (const ContactDescription& contact : scene.contacts) {
    places.push_back(place_of(mesh, PlaceRole::contact, contact.surface));
    places.back().direction = contact_frame(mesh, contact).row(0);
  }
  return places;
}

std::vector<PatchPreload> patch_preloads(const mesh::Mesh& mesh, const SceneDescription& scene,
                                         std::size_t index) {
  std::vector<PatchPreload> preloads;
  if (!scene.response) return preloads;
  const double share = preload_shares(mesh, scene)[index];
  const double area = mesh.surface(scene.contacts[index].surface).area;
  const std::optional<double> stiffness = normal_stiffness(mesh, scene);
  for (const PreloadEntry& entry : scene.response->preload) {
    if (std::holds_alternative<LimitName>(entry) || std::holds_alternative<StaticPreload>(entry)) {
      continue;
    }
    if (const auto* gap = std::get_if<UniformGap>(&entry)) {
      preloads.push_back({.text = "", .gap = gap->width});
      continue;
    }
    const double load = std::get<double>(entry);
    PatchPreload& preload = preloads.emplace_back();
    preload.text = fmt::format("{:g} N", load);
    preload.pressure = std::max(0.0, share * load / area);
    if (load >= 0.0) continue;
    preload.gap_needs_modes = !stiffness;
    if (stiffness) preload.gap = -load / *stiffness;
  }
  return preloads;
}

std::vector<std::string> describe_places(const mesh::Mesh& mesh, const SceneDescription& scene) {
  std::vector<std::string> lines;
  if (const auto* step = std::get_if<StepModel>(&scene.model)) lines.push_back(unit_text(*step));
  std::size_t contact = 0;
  for (const ScenePlace& place : scene_places(mesh, scene)) {
    lines.push_back(line_of(place));
    if (place.role == PlaceRole::contact) add_contact(mesh, scene, contact++, lines);
  }
  for (const LocatedPoint& point : locate_points(mesh, scene)) {
    const Eigen::Vector3d node = mesh.nodes().row(point.node);
    lines.push_back(fmt::format("point {}: the nearest node, at {} m, is {:.3g} m away", point.name,
                                vector_text(node), rounded(point.distance)));
  }
  if (scene.rotation) {
    lines.push_back(fmt::format("rotation: {:.6g} rpm about {} through {} m",
                                30.0 * scene.rotation->speed / std::numbers::pi,
                                vector_text(scene.rotation->direction),
                                vector_text(scene.rotation->origin)));
  }
  return lines;
}

}  // namespace microslip::pipelines
