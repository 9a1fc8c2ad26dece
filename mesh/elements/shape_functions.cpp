#include "mesh/shape_functions.hpp"

#include <algorithm>
#include <array>
#include <cassert>

namespace microslip::mesh {
namespace {

constexpr std::array<std::array<int, 2>, 6> tet_edges{
    {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}}};
constexpr std::array<std::array<int, 2>, 3> tri_edges{{{0, 1}, {1, 2}, {0, 2}}};
constexpr std::array<std::array<int, 2>, 9> wedge_edges{
    {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}}};
constexpr std::array<std::array<int, 2>, 8> pyramid_edges{
    {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 4}, {2, 4}, {3, 4}}};
constexpr std::array<std::array<double, 3>, 20> hex_nodes{{
    {-1, -1, -1}, {1, -1, -1}, {1, 1, -1},  {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1},
    {-1, 1, 1},   {0, -1, -1}, {1, 0, -1},  {0, 1, -1},  {-1, 0, -1}, {0, -1, 1}, {1, 0, 1},
    {0, 1, 1},    {-1, 0, 1},  {-1, -1, 0}, {1, -1, 0},  {1, 1, 0},   {-1, 1, 0},
}};
constexpr std::array<std::array<double, 2>, 8> quad_nodes{
    {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {0, -1}, {1, 0}, {0, 1}, {-1, 0}}};

/// Simplex in D dimensions: barycentric coordinates L, linear or quadratic.
template <int D, typename Shapes, typename Edges>
Shapes simplex(const Eigen::Matrix<double, D, 1>& xi, const Edges& edges, bool quadratic) {
  constexpr int corners = D + 1;
  Eigen::Matrix<double, corners, 1> L;
  L[0] = 1.0 - xi.sum();
  L.template tail<D>() = xi;
  Eigen::Matrix<double, corners, D> dL;
  dL.row(0).setConstant(-1.0);
  dL.template bottomRows<D>().setIdentity();
  Shapes s;
  if (!quadratic) {
    s.values = L;
    s.gradients = dL;
    return s;
  }
  const auto n = static_cast<Eigen::Index>(corners + edges.size());
  s.values.resize(n);
  s.gradients.resize(n, D);
  for (int a = 0; a < corners; ++a) {
    s.values[a] = L[a] * (2.0 * L[a] - 1.0);
    s.gradients.row(a) = (4.0 * L[a] - 1.0) * dL.row(a);
  }
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto [i, j] = edges[e];
    const auto a = static_cast<Eigen::Index>(corners + e);
    s.values[a] = 4.0 * L[i] * L[j];
    s.gradients.row(a) = 4.0 * (L[i] * dL.row(j) + L[j] * dL.row(i));
  }
  return s;
}

/// Linear and serendipity elements on [−1, 1]^D. A mid-side node has one coordinate 0.
template <int D, typename Shapes, typename Nodes>
Shapes cube(const Eigen::Matrix<double, D, 1>& xi, const Nodes& nodes, int n, int corners) {
  Shapes s;
  s.values.resize(n);
  s.gradients.resize(n, D);
  const bool quadratic = n > corners;
  const double scale = 1.0 / (1 << D);
  for (int a = 0; a < n; ++a) {
    Eigen::Matrix<double, D, 1> factor;
    Eigen::Matrix<double, D, 1> slope;
    for (int d = 0; d < D; ++d) {
      const double node = nodes[static_cast<std::size_t>(a)][static_cast<std::size_t>(d)];
      factor[d] = node == 0.0 ? 1.0 - xi[d] * xi[d] : 1.0 + node * xi[d];
      slope[d] = node == 0.0 ? -2.0 * xi[d] : node;
    }
    double extra = 1.0;  // (Σ ξ_a ξ − (D − 1)) of a serendipity corner
    const bool corner = a < corners;
    if (quadratic && corner) {
      extra = 1.0 - D;
      for (int d = 0; d < D; ++d) {
        extra += nodes[static_cast<std::size_t>(a)][static_cast<std::size_t>(d)] * xi[d];
      }
    }
    const double weight = quadratic && !corner ? 2.0 * scale : scale;
    s.values[a] = weight * factor.prod() * extra;
    for (int d = 0; d < D; ++d) {
      double product = slope[d] * extra;
      if (quadratic && corner) {
        product += factor[d] * nodes[static_cast<std::size_t>(a)][static_cast<std::size_t>(d)];
      }
      for (int other = 0; other < D; ++other) {
        if (other != d) product *= factor[other];
      }
      s.gradients(a, d) = weight * product;
    }
  }
  return s;
}

/// Functions of the triangle times 1 ± ζ of the height; the middles of the edges between the
/// triangles, L_i (1 − ζ²), take half of theirs from the corners at both ends.
ElementShapes wedge(const Eigen::Vector3d& xi, bool quadratic) {
  const Eigen::Vector2d place = xi.head<2>();
  const double z = xi[2];
  const FaceShapes T = simplex<2, FaceShapes>(place, tri_edges, quadratic);
  ElementShapes s;
  s.values.resize(quadratic ? 15 : 6);
  s.gradients.resize(s.values.size(), 3);
  for (Eigen::Index a = 0; a < T.values.size(); ++a) {
    const Eigen::Index below = a < 3 ? a : a + 3;
    for (const double end : {-1.0, 1.0}) {
      const Eigen::Index node = end < 0.0 ? below : below + 3;
      const double height = 0.5 * (1.0 + end * z);
      s.values[node] = T.values[a] * height;
      s.gradients.row(node) << height * T.gradients.row(a), 0.5 * end * T.values[a];
    }
  }
  if (!quadratic) return s;
  const FaceShapes L = simplex<2, FaceShapes>(place, tri_edges, false);
  for (Eigen::Index i = 0; i < 3; ++i) {
    s.values[12 + i] = (1.0 - z * z) * L.values[i];
    s.gradients.row(12 + i) << (1.0 - z * z) * L.gradients.row(i), -2.0 * z * L.values[i];
    for (const Eigen::Index corner : {i, i + 3}) {
      s.values[corner] -= 0.5 * s.values[12 + i];
      s.gradients.row(corner) -= 0.5 * s.gradients.row(12 + i);
    }
  }
  return s;
}

/// g(a, b, w) = N/w of one node of a pyramid and its derivatives.
struct Collapsed {
  double value;
  double by_a;
  double by_b;
  double by_w;
};

/// @param x, y  the corner of the base, ±1.
Collapsed pyramid_corner(double x, double y, const Eigen::Vector3d& at, bool quadratic) {
  const auto [a, b, w] = std::array{at[0], at[1], at[2]};
  const double A = 0.5 * (1.0 + x * a);
  const double B = 0.5 * (1.0 + y * b);
  if (!quadratic) return {A * B, 0.5 * x * B, 0.5 * y * A, 0.0};
  const double slant = x * a + y * b;
  const double factor = w * slant - 1.0;
  return {A * B * factor, x * B * (0.5 * factor + w * A), y * A * (0.5 * factor + w * B),
          A * B * slant};
}

/// The middle of the edge from a corner of the base to the apex: (1 − w)(1 ± a)(1 ± b).
Collapsed pyramid_slope(double x, double y, const Eigen::Vector3d& at) {
  const auto [a, b, w] = std::array{at[0], at[1], at[2]};
  const double A = 1.0 + x * a;
  const double B = 1.0 + y * b;
  return {(1.0 - w) * A * B, (1.0 - w) * x * B, (1.0 - w) * y * A, -A * B};
}

/// The middle of an edge of the base, at (x, 0) or (0, y): ½ w (1 − b²)(1 ± a).
Collapsed pyramid_base(double x, double y, const Eigen::Vector3d& at) {
  const auto [a, b, w] = std::array{at[0], at[1], at[2]};
  const double A = y == 0.0 ? 1.0 + x * a : 1.0 - a * a;
  const double B = x == 0.0 ? 1.0 + y * b : 1.0 - b * b;
  const double A_slope = y == 0.0 ? x : -2.0 * a;
  const double B_slope = x == 0.0 ? y : -2.0 * b;
  return {0.5 * w * A * B, 0.5 * w * A_slope * B, 0.5 * w * A * B_slope, 0.5 * A * B};
}

ElementShapes pyramid(const Eigen::Vector3d& xi, bool quadratic) {
  const double w = 1.0 - xi[2];
  const Eigen::Vector3d at =
      w == 0.0 ? Eigen::Vector3d::Zero() : Eigen::Vector3d(xi[0] / w, xi[1] / w, w);
  ElementShapes s;
  s.values.resize(quadratic ? 13 : 5);
  s.gradients.resize(s.values.size(), 3);
  const auto set = [&](Eigen::Index node, const Collapsed& g) {
    s.values[node] = w * g.value;
    s.gradients.row(node) << g.by_a, g.by_b, at[0] * g.by_a + at[1] * g.by_b - g.value - w * g.by_w;
  };
  for (Eigen::Index i = 0; i < 4; ++i) {
    const auto [x, y] = quad_nodes[static_cast<std::size_t>(i)];
    set(i, pyramid_corner(x, y, at, quadratic));
    if (!quadratic) continue;
    const auto [edge_x, edge_y] = quad_nodes[static_cast<std::size_t>(4 + i)];
    set(5 + i, pyramid_base(edge_x, edge_y, at));
    set(9 + i, pyramid_slope(x, y, at));
  }
  s.values[4] = quadratic ? xi[2] * (2.0 * xi[2] - 1.0) : xi[2];
  s.gradients.row(4) << 0.0, 0.0, quadratic ? 4.0 * xi[2] - 1.0 : 1.0;
  return s;
}

using FaceTable = std::vector<std::vector<int>>;

FaceTable corners_of_faces(Solid solid) {
  switch (solid) {
    case Solid::tetrahedron:
      return {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
    case Solid::hexahedron:
      return {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
    case Solid::wedge:
      return {{0, 2, 1}, {3, 4, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}};
    case Solid::pyramid:
      return {{0, 3, 2, 1}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
  }
  return {};
}

/// Corners first; the edge nodes follow from them, each between a corner and the next.
FaceTable face_table(ElementType type) {
  FaceTable table = corners_of_faces(solid(type));
  const Eigen::MatrixX3d nodes = reference_nodes(type);
  for (auto& face : table) {
    const std::size_t corners = face.size();
    for (std::size_t i = 0; i < corners; ++i) {
      const Eigen::RowVector3d middle =
          0.5 * (nodes.row(face[i]) + nodes.row(face[(i + 1) % corners]));
      for (int a = n_corners(type); a < n_nodes(type); ++a) {
        if ((nodes.row(a) - middle).norm() < 1e-12) face.push_back(a);
      }
    }
  }
  return table;
}

template <std::size_t n_edges>
void set_middles(const std::array<std::array<int, 2>, n_edges>& edges, Eigen::Index n_corners,
                 Eigen::MatrixX3d& nodes) {
  for (Eigen::Index a = n_corners; a < nodes.rows(); ++a) {
    const auto [i, j] = edges[static_cast<std::size_t>(a - n_corners)];
    nodes.row(a) = 0.5 * (nodes.row(i) + nodes.row(j));
  }
}

}  // namespace

ElementShapes shapes(ElementType type, const Eigen::Vector3d& xi) {
  switch (type) {
    case ElementType::tet4:
      return simplex<3, ElementShapes>(xi, tet_edges, false);
    case ElementType::tet10:
      return simplex<3, ElementShapes>(xi, tet_edges, true);
    case ElementType::hex8:
      return cube<3, ElementShapes>(xi, hex_nodes, 8, 8);
    case ElementType::hex20:
      return cube<3, ElementShapes>(xi, hex_nodes, 20, 8);
    case ElementType::wedge6:
    case ElementType::wedge15:
      return wedge(xi, is_quadratic(type));
    case ElementType::pyramid5:
    case ElementType::pyramid13:
      return pyramid(xi, is_quadratic(type));
  }
  return {};
}

FaceShapes shapes(FaceType type, const Eigen::Vector2d& xi) {
  switch (type) {
    case FaceType::tri3:
      return simplex<2, FaceShapes>(xi, tri_edges, false);
    case FaceType::tri6:
      return simplex<2, FaceShapes>(xi, tri_edges, true);
    case FaceType::quad4:
      return cube<2, FaceShapes>(xi, quad_nodes, 4, 4);
    case FaceType::quad8:
      return cube<2, FaceShapes>(xi, quad_nodes, 8, 4);
  }
  return {};
}

Eigen::MatrixX3d reference_nodes(ElementType type) {
  Eigen::MatrixX3d nodes(n_nodes(type), 3);
  switch (solid(type)) {
    case Solid::tetrahedron:
      nodes.topRows<4>() << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1;
      set_middles(tet_edges, 4, nodes);
      break;
    case Solid::hexahedron:
      for (Eigen::Index a = 0; a < nodes.rows(); ++a) {
        nodes.row(a) =
            Eigen::Map<const Eigen::RowVector3d>(hex_nodes[static_cast<std::size_t>(a)].data());
      }
      break;
    case Solid::wedge:
      nodes.topRows<6>() << 0, 0, -1, 1, 0, -1, 0, 1, -1, 0, 0, 1, 1, 0, 1, 0, 1, 1;
      set_middles(wedge_edges, 6, nodes);
      break;
    case Solid::pyramid:
      nodes.topRows<5>() << -1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0, 0, 0, 1;
      set_middles(pyramid_edges, 5, nodes);
      break;
  }
  return nodes;
}

std::span<const std::vector<int>> faces(ElementType type) {
  static const auto tables = [] {
    std::array<FaceTable, all_element_types.size()> all;
    for (const ElementType each : all_element_types) {
      all[static_cast<std::size_t>(each)] = face_table(each);
    }
    return all;
  }();
  return tables[static_cast<std::size_t>(type)];
}

FaceType face_type(ElementType type, std::size_t face) {
  // No two types of face have as many nodes.
  const auto* found = std::ranges::find(all_face_types, static_cast<int>(faces(type)[face].size()),
                                        [](FaceType t) { return n_nodes(t); });
  assert(found != all_face_types.end());
  return *found;
}

}  // namespace microslip::mesh
