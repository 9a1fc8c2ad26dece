#include "mesh/elements/element_split.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/LU>

#include "mesh/shape_functions.hpp"

namespace microslip::mesh {
namespace {

using Corners = std::vector<Eigen::Vector3d>;

template <typename Values>
CornerShares shares_of(const Values& values) {
  CornerShares shares;
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    const auto share = static_cast<int>(std::lround(whole_corner * values[i]));
    if (share != 0) shares.emplace_back(static_cast<int>(i), share);
  }
  return shares;
}

ElementType of_order(Solid kind, bool quadratic) {
  return *std::ranges::find_if(all_element_types, [&](ElementType type) {
    return solid(type) == kind && is_quadratic(type) == quadratic;
  });
}

/// Corners, and the middles between them.
class Middles {
 public:
  explicit Middles(ElementType type) : corners_(reference_nodes(linear(type))) {}
  [[nodiscard]] Eigen::Vector3d at(int i) const { return corners_.row(i); }
  [[nodiscard]] Eigen::Vector3d at(int i, int j) const { return 0.5 * (at(i) + at(j)); }

 private:
  Eigen::MatrixX3d corners_;
};

/// Turned so that its volume is positive.
Corners tetrahedron(Corners c) {
  Eigen::Matrix3d edges;
  for (int i = 0; i < 3; ++i) edges.col(i) = c[static_cast<std::size_t>(i) + 1] - c[0];
  if (edges.determinant() < 0.0) std::swap(c[2], c[3]);
  return c;
}

struct Part {
  Solid kind;
  Corners corners;
};

std::vector<Part> parts_of_tetrahedron(const Middles& m, int diagonal) {
  std::vector<Part> parts;
  const auto add = [&](Corners c) {
    parts.push_back({Solid::tetrahedron, tetrahedron(std::move(c))});
  };
  for (int i = 0; i < 4; ++i) add({m.at(i, 0), m.at(i, 1), m.at(i, 2), m.at(i, 3)});
  // From the middle of edge 0a to that of bc, and round the four middles between.
  const int a = diagonal + 1;
  const int b = a % 3 + 1;
  const int c = b % 3 + 1;
  const std::array<Eigen::Vector3d, 4> ring{m.at(0, b), m.at(0, c), m.at(a, c), m.at(a, b)};
  for (std::size_t i = 0; i < ring.size(); ++i) {
    add({m.at(0, a), m.at(b, c), ring[i], ring[(i + 1) % ring.size()]});
  }
  return parts;
}

std::vector<Part> parts_of_hexahedron() {
  const Eigen::MatrixX3d corners = reference_nodes(ElementType::hex8);
  std::vector<Part> parts;
  for (Eigen::Index i = 0; i < corners.rows(); ++i) {
    Corners part;
    for (Eigen::Index j = 0; j < corners.rows(); ++j) {
      part.emplace_back(0.5 * (corners.row(i) + corners.row(j)));
    }
    parts.push_back({Solid::hexahedron, part});
  }
  return parts;
}

std::vector<Part> parts_of_wedge(const Middles& m) {
  const std::array<std::array<Eigen::Vector3d, 3>, 4> triangles{
      {{m.at(0), m.at(0, 1), m.at(0, 2)},
       {m.at(0, 1), m.at(1), m.at(1, 2)},
       {m.at(0, 2), m.at(1, 2), m.at(2)},
       {m.at(0, 1), m.at(1, 2), m.at(0, 2)}}};  // on the lower triangle, ζ = −1
  std::vector<Part> parts;
  for (const auto& triangle : triangles) {
    for (const double lower : {0.0, 1.0}) {
      Corners part;
      for (const double height : {lower, lower + 1.0}) {
        for (const Eigen::Vector3d& corner : triangle) {
          part.emplace_back(corner + height * Eigen::Vector3d::UnitZ());
        }
      }
      parts.push_back({Solid::wedge, part});
    }
  }
  return parts;
}

std::vector<Part> parts_of_pyramid(const Middles& m) {
  constexpr int apex = 4;
  const Eigen::Vector3d centre = m.at(0, 2);  // of the base
  std::vector<Part> parts;
  for (int i = 0; i < apex; ++i) {
    const int next = (i + 1) % apex;
    const int before = (i + 3) % apex;
    parts.push_back(
        {Solid::pyramid, {m.at(i), m.at(i, next), centre, m.at(i, before), m.at(i, apex)}});
    parts.push_back({Solid::tetrahedron,
                     tetrahedron({m.at(i, next), centre, m.at(i, apex), m.at(next, apex)})});
  }
  const Corners ring{m.at(0, apex), m.at(1, apex), m.at(2, apex), m.at(3, apex)};
  parts.push_back({Solid::pyramid, {ring[0], ring[1], ring[2], ring[3], m.at(apex)}});
  parts.push_back({Solid::pyramid, {ring[0], ring[3], ring[2], ring[1], centre}});
  return parts;
}

std::vector<Part> parts_of(ElementType type, int diagonal) {
  const Middles m(type);
  switch (solid(type)) {
    case Solid::tetrahedron:
      return parts_of_tetrahedron(m, diagonal);
    case Solid::hexahedron:
      return parts_of_hexahedron();
    case Solid::wedge:
      return parts_of_wedge(m);
    case Solid::pyramid:
      break;
  }
  return parts_of_pyramid(m);
}

/// Number of a place among others; it joins them.
int number_of(const Eigen::Vector3d& place, Corners& places) {
  constexpr double same = 1e-9;
  const auto found = std::ranges::find_if(
      places, [&](const Eigen::Vector3d& other) { return (other - place).norm() < same; });
  if (found == places.end()) {
    places.push_back(place);
    return static_cast<int>(places.size()) - 1;
  }
  return static_cast<int>(found - places.begin());
}

/// Places of all nodes of a part, in the reference coordinates of the whole.
Corners nodes_of(const Part& part, ElementType type) {
  const Eigen::MatrixX3d own = reference_nodes(type);
  Corners nodes;
  for (Eigen::Index a = 0; a < own.rows(); ++a) {
    const auto values = shapes(linear(type), Eigen::Vector3d(own.row(a))).values;
    Eigen::Vector3d place = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < part.corners.size(); ++i) {
      place += values[static_cast<Eigen::Index>(i)] * part.corners[i];
    }
    nodes.push_back(place);
  }
  return nodes;
}

/// The lattice on a face: its corners and the middles of its edges and of a quadrilateral; with
/// `n` = 4 the quarters too.
std::vector<Eigen::Vector2d> lattice(bool is_triangle, int n) {
  std::vector<Eigen::Vector2d> places;
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= (is_triangle ? n - j : n); ++i) {
      const Eigen::Vector2d unit(static_cast<double>(i) / n, static_cast<double>(j) / n);
      places.push_back(is_triangle ? unit : Eigen::Vector2d(2.0 * unit.array() - 1.0));
    }
  }
  return places;
}

Corners rows_of(const Eigen::MatrixX3d& nodes) {
  Corners rows;
  for (Eigen::Index a = 0; a < nodes.rows(); ++a) rows.emplace_back(nodes.row(a));
  return rows;
}

/// @param quadratic  the parts.
ElementSplit split_into(const std::vector<Part>& parts, ElementType type, bool quadratic) {
  ElementSplit split;
  Corners places = rows_of(reference_nodes(type));
  for (const Part& part : parts) {
    ElementSplit::Child child{of_order(part.kind, quadratic), {}};
    for (const Eigen::Vector3d& node : nodes_of(part, child.type)) {
      child.points.push_back(number_of(node, places));
    }
    split.children.push_back(std::move(child));
  }
  split.points.resize(std::ssize(places), 3);
  split.shapes.resize(std::ssize(places), n_nodes(type));
  for (Eigen::Index i = 0; i < split.points.rows(); ++i) {
    const Eigen::Vector3d& place = places[static_cast<std::size_t>(i)];
    split.points.row(i) = place;
    split.shapes.row(i) = shapes(type, place).values;
    split.shares.push_back(shares_of(shapes(linear(type), place).values));
  }
  return split;
}

}  // namespace

ElementSplit element_split(ElementType type, int diagonal) {
  return split_into(parts_of(type, diagonal), type, is_quadratic(type));
}

ElementSplit midside_split(ElementType type) {
  return split_into({{solid(type), rows_of(reference_nodes(linear(type)))}}, type, true);
}

FaceSplit face_split(FaceType type) {
  const int n = n_corners(type);
  const FaceType with_corners = n == 3 ? FaceType::tri3 : FaceType::quad4;
  FaceSplit split;
  for (const Eigen::Vector2d& place : lattice(n == 3, n_nodes(type) > n ? 4 : 2)) {
    split.shares.push_back(shares_of(shapes(with_corners, place).values));
  }
  const auto between = [&](std::vector<int> corners) {
    CornerShares wanted;
    std::ranges::sort(corners);
    for (const int corner : corners) {
      const int share = whole_corner / static_cast<int>(corners.size());
      if (!wanted.empty() && wanted.back().first == corner) {
        wanted.back().second += share;
      } else {
        wanted.emplace_back(corner, share);
      }
    }
    return static_cast<int>(std::ranges::find(split.shares, wanted) - split.shares.begin());
  };
  for (int i = 0; i < n; ++i) {
    const int next = (i + 1) % n;
    const int before = (i + n - 1) % n;
    std::vector<int> child{between({i}), between({i, next}), between({i, before})};
    if (n == 4) child.insert(child.begin() + 2, between({0, 1, 2, 3}));
    split.children.push_back(child);
  }
  if (n == 3) split.children.push_back({between({0, 1}), between({1, 2}), between({2, 0})});
  return split;
}

}  // namespace microslip::mesh
