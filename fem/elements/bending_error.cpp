#include "fem/bending_error.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <Eigen/Geometry>

#include "mesh/outer_faces.hpp"

namespace microslip::fem {
namespace {

struct Skin {
  double area = 0.0;  ///< [m²]
  double side = 0.0;  ///< mean of the longest sides, weighted by area [m]
};

Skin skin_of(const mesh::Mesh& mesh) {
  Skin skin;
  for (const auto& face : mesh::outer_faces(mesh)) {
    const std::size_t n = face[3] < 0 ? 3 : 4;
    const auto at = [&](std::size_t i) { return Eigen::Vector3d(mesh.nodes().row(face[i % n])); };
    double longest = 0.0;
    for (std::size_t i = 0; i < n; ++i) longest = std::max(longest, (at(i + 1) - at(i)).norm());
    const double area = n == 3 ? 0.5 * (at(1) - at(0)).cross(at(2) - at(0)).norm()
                               : 0.5 * (at(2) - at(0)).cross(at(3) - at(1)).norm();
    skin.area += area;
    skin.side += area * longest;
  }
  if (skin.area > 0.0) skin.side /= skin.area;
  return skin;
}

/// (2).
double thickness_of(const mesh::Mesh& mesh, double area) {
  const double section = mesh.volume() / mesh.longest_side();
  const double sides = 0.5 * area * section / mesh.volume();  // t + b
  const double square = 0.25 * sides * sides - section;
  return square > 0.0 ? 0.5 * sides - std::sqrt(square) : std::sqrt(section);
}

}  // namespace

double bending_error(const mesh::Mesh& mesh) {
  if (mesh.elements().empty() || mesh::is_quadratic(mesh.elements().front().type)) return 0.0;
  const Skin skin = skin_of(mesh);
  const bool tetrahedra = mesh::solid(mesh.elements().front().type) == mesh::Solid::tetrahedron;
  const double factor = tetrahedra ? 1.75 : 0.55;
  const double ratio = skin.side / thickness_of(mesh, skin.area);
  return std::sqrt(1.0 + factor * ratio * ratio) - 1.0;
}

}  // namespace microslip::fem
