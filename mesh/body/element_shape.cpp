#include "mesh/element_shape.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <limits>
#include <numbers>
#include <span>
#include <sstream>

#include <Eigen/Geometry>

#include "mesh/count_text.hpp"
#include "mesh/shape_functions.hpp"

namespace microslip::mesh {
namespace {

/// A corner and the corners its edges lead to, right-handed.
using Corner = std::array<int, 4>;
constexpr std::array<Corner, 4> tetrahedron{
    {{0, 1, 2, 3}, {1, 2, 0, 3}, {2, 0, 1, 3}, {3, 0, 2, 1}}};
constexpr std::array<Corner, 6> wedge{
    {{0, 1, 2, 3}, {1, 2, 0, 4}, {2, 0, 1, 5}, {3, 5, 4, 0}, {4, 3, 5, 1}, {5, 4, 3, 2}}};
/// Without the apex, where four edges meet: all dihedral angles and heights are seen from the base.
constexpr std::array<Corner, 4> pyramid{{{0, 1, 3, 4}, {1, 2, 0, 4}, {2, 3, 1, 4}, {3, 0, 2, 4}}};
constexpr std::array<Corner, 8> hexahedron{{{0, 1, 3, 4},
                                            {1, 2, 0, 5},
                                            {2, 3, 1, 6},
                                            {3, 0, 2, 7},
                                            {4, 7, 5, 0},
                                            {5, 4, 6, 1},
                                            {6, 5, 7, 2},
                                            {7, 6, 4, 3}}};

std::span<const Corner> corners_of(ElementType type) {
  switch (solid(type)) {
    case Solid::tetrahedron:
      return tetrahedron;
    case Solid::hexahedron:
      return hexahedron;
    case Solid::wedge:
      return wedge;
    case Solid::pyramid:
      return pyramid;
  }
  return {};
}

constexpr double to_degrees = 180.0 / std::numbers::pi;

/// Elements beyond one limit.
struct Beyond {
  Eigen::Index count = 0;
  double worst = 0.0;
  std::int64_t tag = 0;
  Eigen::RowVector3d centre;

  /// @param excess  how far beyond, comparable between elements; not above 0: within the limit.
  void note(double excess, double value, std::int64_t element, const Eigen::MatrixX3d& nodes) {
    if (!(excess > 0.0)) return;
    if (count++ > 0 && excess <= most_) return;
    most_ = excess;
    worst = value;
    tag = element;
    centre = nodes.colwise().mean();
  }

 private:
  double most_ = 0.0;
};

std::string sentence(const Beyond& beyond, Eigen::Index n_elements, const std::string& what) {
  std::ostringstream text;
  const Eigen::IOFormat place(4, Eigen::DontAlignCols);
  text << beyond.count << " of " << n_elements
       << (beyond.count == 1 ? " elements is a sliver with " : " elements are slivers with ")
       << what << "; the worst is element " << beyond.tag << " with " << beyond.worst << ", near ("
       << beyond.centre.format(place) << ") m";
  return text.str();
}

}  // namespace

ElementShape element_shape(ElementType type, const Eigen::MatrixX3d& nodes) {
  double longest = 0.0;
  double lowest = std::numeric_limits<double>::infinity();
  ElementShape shape{0.0, std::numbers::pi, 0.0};
  for (const Corner& corner : corners_of(type)) {
    std::array<Eigen::Vector3d, 3> e;
    for (std::size_t i = 0; i < 3; ++i)
      e[i] = (nodes.row(corner[i + 1]) - nodes.row(corner[0])).transpose();
    const double volume = e[0].dot(e[1].cross(e[2]));
    for (std::size_t i = 0; i < 3; ++i) {
      const Eigen::Vector3d one = e[i].cross(e[(i + 1) % 3]);
      const Eigen::Vector3d other = e[i].cross(e[(i + 2) % 3]);
      const double angle = std::atan2(e[i].norm() * volume, one.dot(other));
      shape.smallest_angle = std::min(shape.smallest_angle, angle);
      shape.largest_angle = std::max(shape.largest_angle, angle);
      longest = std::max(longest, e[i].norm());
      lowest = std::min(lowest, volume / one.norm());
    }
  }
  shape.aspect_ratio = longest / lowest;
  return shape;
}

std::vector<std::string> shape_warnings(const Mesh& mesh, const ShapeLimits& limits) {
  Beyond thin;
  Beyond sharp;
  Beyond flat;
  for (const ElementBlock& block : mesh.elements()) {
    Eigen::MatrixX3d own(n_corners(block.type), 3);
    for (Eigen::Index e = 0; e < block.connectivity.rows(); ++e) {
      for (Eigen::Index a = 0; a < own.rows(); ++a)
        own.row(a) = mesh.nodes().row(block.connectivity(e, a));
      const ElementShape shape = element_shape(block.type, own);
      const std::int64_t tag = block.tags[static_cast<std::size_t>(e)];
      thin.note(shape.aspect_ratio - limits.aspect_ratio, shape.aspect_ratio, tag, own);
      sharp.note(limits.smallest_angle - shape.smallest_angle, to_degrees * shape.smallest_angle,
                 tag, own);
      flat.note(shape.largest_angle - limits.largest_angle, to_degrees * shape.largest_angle, tag,
                own);
    }
  }
  std::vector<std::string> warnings;
  if (const Eigen::Index n = mesh.n_repeated_elements(); n > 0) {
    warnings.push_back(counted(n, "volume element stands", "volume elements stand") +
                       " in the mesh file more than once; each is taken once");
  }
  const auto add = [&](const Beyond& beyond, const std::string& what, double limit) {
    if (beyond.count == 0) return;
    std::ostringstream text;
    text << what << std::setprecision(3) << limit;
    warnings.push_back(sentence(beyond, mesh.n_elements(), text.str()));
  };
  add(thin, "an aspect ratio above ", limits.aspect_ratio);
  add(sharp, "a dihedral angle [deg] below ", to_degrees * limits.smallest_angle);
  add(flat, "a dihedral angle [deg] above ", to_degrees * limits.largest_angle);
  return warnings;
}

}  // namespace microslip::mesh
