#include "pipelines/import/named_points.hpp"

#include <algorithm>
#include <variant>

#include <fmt/format.h>

#include "mesh/mesh_error.hpp"
#include "pipelines/system/scene_error.hpp"

namespace microslip::pipelines {
namespace {

/// The farthest node that shares an element with this one.
double element_size_at(const mesh::Mesh& mesh, Eigen::Index node) {
  double size = 0.0;
  for (const mesh::ElementBlock& block : mesh.elements()) {
    for (const auto& element : block.connectivity.rowwise()) {
      if (std::find(element.begin(), element.end(), node) == element.end()) continue;
      for (const Eigen::Index other : element) {
        size = std::max(size, (mesh.nodes().row(other) - mesh.nodes().row(node)).norm());
      }
    }
  }
  return size;
}

LocatedPoint located(const mesh::Mesh& mesh, const PointDescription& point,
                     const Eigen::Vector3d& at) {
  LocatedPoint found{.name = point.name, .place = point.place};
  const auto squares = (mesh.nodes().rowwise() - at.transpose()).rowwise().squaredNorm();
  found.distance = std::sqrt(squares.minCoeff(&found.node));
  const double length = (mesh.upper() - mesh.lower()).norm();
  if (found.distance > length) {
    throw SceneError(fmt::format(
        "{}: ({:g}, {:g}, {:g}) m is {:.3g} m from the nearest node, of a mesh that is {:.3g} m "
        "long; a number without unit is in metres: is it meant in millimetres, \"{:g} mm\"?",
        point.place, at.x(), at.y(), at.z(), found.distance, length, at.maxCoeff()));
  }
  found.element_size = element_size_at(mesh, found.node);
  return found;
}

}  // namespace

std::vector<LocatedPoint> locate_points(const mesh::Mesh& mesh, const SceneDescription& scene) {
  std::vector<LocatedPoint> points;
  for (const PointDescription& point : scene.points) {
    const auto* at = std::get_if<Eigen::Vector3d>(&point.of);
    if (at != nullptr) points.push_back(located(mesh, point, *at));
  }
  return points;
}

void name_points(mesh::Mesh& mesh, const SceneDescription& scene) {
  const auto checked = [&](const std::string& place, const auto& action) {
    try {
      action();
    } catch (const mesh::MeshError& error) {
      throw SceneError(place + ": " + error.what());
    }
  };
  for (const PointDescription& point : scene.points) {
    const auto* target = std::get_if<std::string>(&point.of);
    if (target == nullptr) continue;
    checked(point.place, [&] {
      std::vector<Eigen::Index> nodes = mesh.node_set(*target);
      mesh.name_nodes(point.name, std::move(nodes));
    });
  }
  for (const LocatedPoint& point : locate_points(mesh, scene)) {
    checked(point.place, [&] { mesh.name_nodes(point.name, {point.node}); });
  }
}

}  // namespace microslip::pipelines
