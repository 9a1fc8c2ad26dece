#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "fem/bending_error.hpp"
#include "mesh/surface.hpp"
#include "pipelines/description/element_count.hpp"
#include "pipelines/import/named_points.hpp"
#include "pipelines/model/contact_frame.hpp"
#include "pipelines/model/scene_places.hpp"
#include "pipelines/questions/question.hpp"

namespace microslip::pipelines {
namespace {

constexpr double to_degrees = 180.0 / std::numbers::pi;

/// The height of a body that others drew is known once it is meshed.
Findings element_size_of_step(const Facts& facts) {
  const auto* step = std::get_if<StepModel>(&facts.scene.model);
  if (step == nullptr) return {};
  return {{"model.element_size", percent * step->element_size / facts.mesh->longest_side(),
           fmt::format("({:g} m)", step->element_size)}};
}

Findings size(const Facts& facts) {
  const double mass = facts.scene.material.density * facts.mesh->volume();
  const bool blade = std::holds_alternative<BladeModel>(facts.scene.model);
  return {{blade ? "model.span" : "model.length_unit", facts.mesh->longest_side(),
           mass > 0.0 ? fmt::format("and the mass {:.3g} kg", mass) : ""}};
}

Findings circumferential_speed(const Facts& facts) {
  if (!facts.scene.rotation) return {};
  const fem::Rotation& rotation = *facts.scene.rotation;
  double radius = 0.0;
  for (const auto& node : facts.mesh->nodes().rowwise()) {
    const Eigen::Vector3d arm = node.transpose() - rotation.origin;
    radius = std::max(radius, rotation.direction.cross(arm).norm());
  }
  return {
      {"static.speed", rotation.speed * radius, fmt::format("({:.3g} m off the axis)", radius)}};
}

/// Share of the nodes of every place in a role that are held.
Findings held_share(const Facts& facts, PlaceRole role, const char* key) {
  Findings findings;
  std::set<Eigen::Index> held;
  const std::vector<ScenePlace> places = scene_places(*facts.mesh, facts.scene);
  for (const ScenePlace& place : places) {
    if (place.role == PlaceRole::clamped) held.insert(place.nodes.begin(), place.nodes.end());
  }
  for (const ScenePlace& place : places) {
    if (place.role != role) continue;
    const auto n =
        std::ranges::count_if(place.nodes, [&](Eigen::Index node) { return held.contains(node); });
    findings.push_back({key,
                        percent * static_cast<double>(n) / static_cast<double>(place.nodes.size()),
                        fmt::format("of \"{}\"", place.name)});
  }
  return findings;
}

Findings held_contact(const Facts& facts) {
  return held_share(facts, PlaceRole::contact, "supports.clamped");
}
Findings held_force(const Facts& facts) {
  return held_share(facts, PlaceRole::force, "excitation.forces");
}
Findings held_output(const Facts& facts) {
  return held_share(facts, PlaceRole::output, "response.output");
}

/// Angle between the slip direction as given and the face.
Findings slip_angle(const Facts& facts) {
  Findings findings;
  for (const ContactDescription& contact : facts.scene.contacts) {
    const double cosine = std::min(1.0, steepest_place(*facts.mesh, contact).sine);
    findings.push_back({contact.key + ".slip_direction", to_degrees * std::acos(cosine),
                        fmt::format("against \"{}\"", contact.surface)});
  }
  return findings;
}

/// Linear elements cannot keep their volume while they bend:
/// the nearer ν is to 0.5 the stiffer they are.
Findings locking(const Facts& facts) {
  for (const mesh::ElementBlock& block : facts.mesh->elements()) {
    if (mesh::is_quadratic(block.type)) continue;
    return {{"material.poissons_ratio", facts.scene.material.poissons_ratio,
             fmt::format("in {} elements", name(block.type))}};
  }
  return {};
}

/// Modes and matrices that are given come from elements of another code.
Findings stiff_in_bending(const Facts& facts) {
  const auto* file = std::get_if<MeshFileModel>(&facts.scene.model);
  if (file != nullptr && (file->modes || file->matrices)) return {};
  if (facts.mesh->elements().empty()) return {};
  const mesh::ElementType type = facts.mesh->elements().front().type;
  return {{"model.file", percent * fem::bending_error(*facts.mesh),
           fmt::format("too high, by {} elements of this size", name(type))}};
}

Findings pressure(const Facts& facts) {
  Findings findings;
  for (std::size_t i = 0; i < facts.scene.contacts.size(); ++i) {
    for (const PatchPreload& preload : patch_preloads(*facts.mesh, facts.scene, i)) {
      findings.push_back(
          {"response.preload", preload.pressure,
           fmt::format("on \"{}\" under {}", facts.scene.contacts[i].surface, preload.text)});
    }
  }
  return findings;
}

/// Of places from the centroid of a face along p and r [m].
Eigen::AlignedBox2d box_of(const mesh::Mesh& mesh, const ContactDescription& contact) {
  const mesh::Surface& surface = mesh.surface(contact.surface);
  const Eigen::MatrixX3d nodes = mesh.nodes()(surface.nodes, Eigen::all);
  const auto [p, r] = in_plane(nodes, mesh::fit_plane(mesh.nodes(), surface).centroid,
                               contact_frame(mesh, contact));
  return {Eigen::Vector2d(p.minCoeff(), r.minCoeff()), Eigen::Vector2d(p.maxCoeff(), r.maxCoeff())};
}

double reach(const Eigen::AlignedBox2d& box) {
  return box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs()).maxCoeff();
}

std::string extents(const Eigen::AlignedBox2d& box) {
  return fmt::format("p {:.4g} to {:.4g}, r {:.4g} to {:.4g} m", box.min().x(), box.max().x(),
                     box.min().y(), box.max().y());
}

/// How far tables over a face reach.
Findings reach_of_tables(const Facts& facts) {
  Findings findings;
  for (const ContactDescription& contact : facts.scene.contacts) {
    const auto look_at = [&](const Field& field, const char* key) {
      if (!field.table_box) return;
      const Eigen::AlignedBox2d face = box_of(*facts.mesh, contact);
      findings.push_back({fmt::format("{}.{}", contact.key, key),
                          reach(*field.table_box) / reach(face),
                          fmt::format("as far as the face (table {}; face {})",
                                      extents(*field.table_box), extents(face))});
    };
    look_at(contact.friction, "friction_coefficient");
    if (contact.preload_field) look_at(*contact.preload_field, "preload_field");
  }
  return findings;
}

Findings distance_of_points(const Facts& facts) {
  Findings findings;
  for (const LocatedPoint& point : locate_points(*facts.mesh, facts.scene)) {
    findings.push_back({point.place, percent * point.distance / point.element_size,
                        fmt::format("({:.3g} m) from \"{}\"", point.distance, point.name)});
  }
  return findings;
}

/// Names of the mesh in the scene, each with its first key.
std::map<std::string, std::string> names_used(const SceneDescription& scene) {
  std::map<std::string, std::string> keys;
  for (const ContactDescription& contact : scene.contacts) {
    keys.emplace(contact.surface, contact.key + ".surface");
  }
  for (const std::string& name : scene.clamped) keys.emplace(name, "supports.clamped");
  for (const ForceDescription& force : scene.forces) keys.emplace(force.at, "excitation.forces");
  for (const ForceDescription& force : scene.static_loads.forces) {
    keys.emplace(force.at, "static.forces");
  }
  for (const PressureDescription& entry : scene.static_loads.pressures) {
    keys.emplace(entry.surface, "static.pressure");
  }
  if (scene.response) keys.emplace(scene.response->output.at, "response.output");
  return keys;
}

/// A surface and a node set of one name are two things where their nodes differ.
Findings two_of_one_name(const Facts& facts) {
  const mesh::Mesh& mesh = *facts.mesh;
  const std::vector<std::string> surfaces = mesh.surface_names();
  Findings findings;
  for (const auto& [name, key] : names_used(facts.scene)) {
    const auto set = mesh.node_sets().find(name);
    if (set == mesh.node_sets().end() || set->second.empty()) continue;
    if (std::ranges::count(surfaces, name) == 0) continue;
    const std::vector<Eigen::Index>& on_surface = mesh.surface(name).nodes;
    const std::set<Eigen::Index> a(on_surface.begin(), on_surface.end());
    const std::set<Eigen::Index> b(set->second.begin(), set->second.end());
    std::vector<Eigen::Index> apart;
    std::ranges::set_symmetric_difference(a, b, std::back_inserter(apart));
    findings.push_back({key, static_cast<double>(apart.size()),
                        fmt::format("of surface \"{}\" ({} nodes) and node set \"{}\" ({} nodes)",
                                    name, a.size(), name, b.size())});
  }
  return findings;
}

constexpr std::array about_mesh{
    Question{"the element size", "% of the blade's height", percent* smallest_usual_element,
             percent* largest_usual_element, "", "is it in millimetres? give the unit",
             element_size_of_step},
    Question{"the longest side of the mesh", "m", 2e-3, 3.0, "blades 0.02 to 3",
             "is the file in another unit than length_unit says?", size, true},
    Question{"the speed of the outermost point", "m/s", 0.0, 900.0, "blades 200 to 600",
             "is it in rpm? give the unit; does the axis stand where it should, in metres?",
             circumferential_speed},
    Question{"the clamped share", "% of the nodes", 0.0, 50.0, "", "what is held does not rub",
             held_contact},
    Question{"the clamped share", "% of the nodes", 0.0, 99.0, "",
             "a force on what is held moves nothing", held_force},
    Question{"the clamped share", "% of the nodes", 0.0, 99.0, "", "what is held does not move",
             held_output},
    Question{"the slip direction rises", "degrees", 0.0, 60.0, "",
             "it is nearly the normal, and p is the little of it that lies in the face",
             slip_angle},
    Question{
        "Poisson's ratio", "", -1.0, 0.45, "",
        "linear elements of a material that keeps its volume lock, frequencies come out too high; "
        "use quadratic ones",
        locking},
    Question{"in bending, frequencies may be", "%", 0.0, 2.0, "",
             "linear elements are too stiff there; use quadratic ones (gmsh -order 2) or more over "
             "the thickness",
             stiff_in_bending},
    Question{"the mean pressure", "Pa", 0.0, 3e9, "yield of steels 3e8 to 2e9",
             "is the preload in newtons, the mesh in its unit?", pressure},
    Question{"the table reaches", "times", 0.0, 3.0, "",
             "p and r are in metres from the centroid of the face; are they in millimetres? divide "
             "them by 1000",
             reach_of_tables},
    Question{"the nearest node is", "% of an element", 0.0, 100.0, "",
             "is the point on the body, and in the axes of the mesh?", distance_of_points},
    Question{"the number of nodes that are not in both", "", 0.0, 0.0, "",
             "a contact, a pressure, forces and output take the surface, supports the set; rename "
             "one of them in the file if that is not what you mean",
             two_of_one_name},
};

}  // namespace

std::span<const Question> mesh_questions() { return about_mesh; }

}  // namespace microslip::pipelines
