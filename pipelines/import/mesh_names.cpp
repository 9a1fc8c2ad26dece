#include "pipelines/import/mesh_names.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "mesh/count_text.hpp"
#include "pipelines/import/mesh_file.hpp"

namespace microslip::pipelines {
namespace {

void add_faces(const mesh::Mesh& mesh, MeshName& entry) {
  const mesh::Surface& surface = mesh.surface(entry.name);
  const mesh::SurfacePlane plane = mesh::fit_plane(mesh.nodes(), surface);
  for (const mesh::FaceBlock& block : surface.faces) entry.n_faces += block.connectivity.rows();
  entry.area = surface.area;
  entry.centre = plane.centroid;
  entry.normal = plane.normal;
  entry.flatness = plane.flatness / plane.diameter;
}

/// Without the digits that rounding leaves: −1.2e-17 of a bounding box of 1 is 0.
std::string place(const Eigen::Vector3d& x, double size) {
  const auto clean = [&](double value) { return std::abs(value) < 1e-9 * size ? 0.0 : value; };
  return fmt::format("{:.4g} {:.4g} {:.4g}", clean(x.x()), clean(x.y()), clean(x.z()));
}

std::string table_row(const MeshName& name, double size) {
  const bool faces = name.n_faces > 0;
  return fmt::format(
      "{:<20} {:<9}{:>7}{:>8}{:>12}  {:<28} {:<24} {}\n", name.name, kind_name(name.kind),
      name.n_faces, name.n_nodes, faces ? fmt::format("{:.5g}", name.area) : "-",
      name.n_nodes > 0 ? place(name.centre, size) : "-", faces ? place(name.normal, 1.0) : "-",
      faces ? fmt::format("{:.1g}", name.flatness) : "-");
}

}  // namespace

std::string kind_name(MeshName::Kind kind) {
  switch (kind) {
    case MeshName::Kind::surface:
      return "surface";
    case MeshName::Kind::node_set:
      return "node set";
    case MeshName::Kind::point:
      return "point";
  }
  return {};
}

std::vector<MeshName> mesh_names(const mesh::Mesh& mesh) {
  std::vector<MeshName> names;
  const std::vector<std::string> surfaces = mesh.surface_names();
  for (const std::string& name : surfaces) {
    MeshName& entry = names.emplace_back(MeshName{name});
    if (!mesh.has_faces(name)) continue;
    entry.n_nodes = std::ssize(mesh.surface(name).nodes);
    add_faces(mesh, entry);
  }
  for (const std::string& name : mesh.node_set_names()) {
    const std::vector<Eigen::Index>& nodes = mesh.node_sets().at(name);
    const auto kind = nodes.size() == 1 ? MeshName::Kind::point : MeshName::Kind::node_set;
    MeshName& entry = names.emplace_back(MeshName{name, kind});
    entry.n_nodes = std::ssize(nodes);
    if (!nodes.empty()) entry.centre = mesh.nodes()(nodes, Eigen::all).colwise().mean();
    const bool is_surface = std::ranges::find(surfaces, name) != surfaces.end();
    if (!is_surface && mesh.has_faces(name)) add_faces(mesh, entry);
  }
  return names;
}

std::string describe_names(const mesh::Mesh& mesh, std::optional<double> unit) {
  const Eigen::Vector3d box = mesh.upper() - mesh.lower();
  std::string text = fmt::format("{} nodes, {}, ", mesh.n_nodes(),
                                 mesh::counted(mesh.n_elements(), "element", "elements"));
  text += unit ? fmt::format("{} m; lengths below are in m\n", place(box, box.maxCoeff()))
               : fmt::format("{}; the file does not tell its unit, lengths below are in it\n",
                             size_readings(mesh));
  text += fmt::format("{:<20} {:<9}{:>7}{:>8}{:>12}  {:<28} {:<24} {}\n", "name", "kind", "faces",
                      "nodes", "area", "centre", "normal", "flatness");
  const std::vector<MeshName> names = mesh_names(mesh);
  for (const MeshName& name : names) text += table_row(name, box.maxCoeff());
  if (std::ranges::none_of(names, [](const MeshName& name) { return name.n_faces > 0; })) {
    text +=
        "no name holds a face, so that nothing can rub: name the faces in the file; how each "
        "format "
        "does that stands in share/doc/meshes.md\n";
  }
  return text;
}

}  // namespace microslip::pipelines
