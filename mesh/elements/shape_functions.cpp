#include "mesh/shape_functions.hpp"

namespace microslip::mesh {
namespace {

constexpr std::array<std::array<int, 2>, 6> tet_edges{
    {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}}};
constexpr std::array<std::array<int, 2>, 3> tri_edges{{{0, 1}, {1, 2}, {0, 2}}};
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

std::vector<std::vector<int>> face_table(ElementType type) {
  // Corners first; the edge nodes follow from them.
  const bool tet = type == ElementType::tet4 || type == ElementType::tet10;
  std::vector<std::vector<int>> table =
      tet ? std::vector<std::vector<int>>{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}
          : std::vector<std::vector<int>>{{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                          {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
  if (type == ElementType::tet4 || type == ElementType::hex8) return table;
  const Eigen::MatrixX3d nodes = reference_nodes(type);
  for (auto& face : table) {
    const std::size_t corners = face.size();
    for (std::size_t i = 0; i < corners; ++i) {
      // tri6 and quad8 list their edges as 01 12 (23) and the closing one last; tri6 closes with
      // 02.
      const Eigen::RowVector3d middle =
          0.5 * (nodes.row(face[i]) + nodes.row(face[(i + 1) % corners]));
      for (int a = n_corners(type); a < n_nodes(type); ++a) {
        if ((nodes.row(a) - middle).norm() < 1e-12) face.push_back(a);
      }
    }
  }
  return table;
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
  if (type == ElementType::hex8 || type == ElementType::hex20) {
    for (Eigen::Index a = 0; a < nodes.rows(); ++a) {
      nodes.row(a) =
          Eigen::Map<const Eigen::RowVector3d>(hex_nodes[static_cast<std::size_t>(a)].data());
    }
    return nodes;
  }
  nodes.topRows<4>() << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1;
  for (Eigen::Index a = 4; a < nodes.rows(); ++a) {
    const auto [i, j] = tet_edges[static_cast<std::size_t>(a - 4)];
    nodes.row(a) = 0.5 * (nodes.row(i) + nodes.row(j));
  }
  return nodes;
}

std::span<const std::vector<int>> faces(ElementType type) {
  static const std::array<std::vector<std::vector<int>>, 4> tables{
      face_table(ElementType::tet4), face_table(ElementType::tet10), face_table(ElementType::hex8),
      face_table(ElementType::hex20)};
  return tables[static_cast<std::size_t>(type)];
}

FaceType face_type(ElementType type) {
  constexpr std::array types{FaceType::tri3, FaceType::tri6, FaceType::quad4, FaceType::quad8};
  return types[static_cast<std::size_t>(type)];
}

int n_corners(ElementType type) {
  return type == ElementType::tet4 || type == ElementType::tet10 ? 4 : 8;
}

int n_corners(FaceType type) { return type == FaceType::tri3 || type == FaceType::tri6 ? 3 : 4; }

}  // namespace microslip::mesh
