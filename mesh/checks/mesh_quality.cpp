#include "mesh/checks/mesh_quality.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <sstream>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "mesh/count_text.hpp"
#include "mesh/mesh_error.hpp"
#include "mesh/shape_functions.hpp"

namespace microslip::mesh {
namespace {

double determinant(ElementType type, const Eigen::MatrixX3d& nodes, const Eigen::Vector3d& xi) {
  const Eigen::Matrix3d J = nodes.transpose() * shapes(type, xi).gradients;
  return J.determinant();
}

/// Exponents (i, j, k, l), i + j + k + l = 3, of the cubic Bernstein basis on a tetrahedron.
const std::vector<std::array<int, 4>>& cubic_exponents() {
  static const std::vector<std::array<int, 4>> list = [] {
    std::vector<std::array<int, 4>> e;
    for (int i = 0; i <= 3; ++i) {
      for (int j = 0; i + j <= 3; ++j) {
        for (int k = 0; i + j + k <= 3; ++k) e.push_back({i, j, k, 3 - i - j - k});
      }
    }
    return e;
  }();
  return list;
}

/// Values at the 20 points (i, j, k, l)/3 → Bernstein coefficients.
const Eigen::Matrix<double, 20, 20>& to_bernstein() {
  static const Eigen::Matrix<double, 20, 20> matrix = [] {
    constexpr std::array<double, 4> factorial{1.0, 1.0, 2.0, 6.0};
    const auto& e = cubic_exponents();
    Eigen::Matrix<double, 20, 20> values;
    for (std::size_t row = 0; row < 20; ++row) {
      for (std::size_t column = 0; column < 20; ++column) {
        double value = 6.0;
        for (std::size_t d = 0; d < 4; ++d) {
          value *= std::pow(e[row][d] / 3.0, e[column][d]) /
                   factorial[static_cast<std::size_t>(e[column][d])];
        }
        values(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column)) = value;
      }
    }
    return Eigen::Matrix<double, 20, 20>(values.inverse());
  }();
  return matrix;
}

using Corners = Eigen::Matrix<double, 4, 3>;  // a sub-tetrahedron in reference coordinates

/// Smallest Bernstein coefficient and sampled extremes on a sub-tetrahedron.
struct Bounds {
  double coefficient;
  double sample;
  double largest;
};

Bounds bounds_on(const Eigen::MatrixX3d& nodes, const Corners& corners) {
  Eigen::Matrix<double, 20, 1> values;
  const auto& e = cubic_exponents();
  for (std::size_t i = 0; i < 20; ++i) {
    Eigen::Vector4d barycentric;
    for (std::size_t d = 0; d < 4; ++d) barycentric[static_cast<Eigen::Index>(d)] = e[i][d] / 3.0;
    values[static_cast<Eigen::Index>(i)] =
        determinant(ElementType::tet10, nodes, corners.transpose() * barycentric);
  }
  const Eigen::Matrix<double, 20, 1> coefficients = to_bernstein() * values;
  return {coefficients.minCoeff(), values.minCoeff(), values.maxCoeff()};
}

std::array<Corners, 8> subdivided(const Corners& c) {
  const auto mid = [&](int i, int j) { return Eigen::RowVector3d(0.5 * (c.row(i) + c.row(j))); };
  const std::array<Eigen::RowVector3d, 10> p{c.row(0),  c.row(1),  c.row(2),  c.row(3),  mid(0, 1),
                                             mid(1, 2), mid(0, 2), mid(0, 3), mid(1, 3), mid(2, 3)};
  constexpr std::array<std::array<std::size_t, 4>, 8> parts{{{0, 4, 6, 7},
                                                             {4, 1, 5, 8},
                                                             {6, 5, 2, 9},
                                                             {7, 8, 9, 3},
                                                             {4, 5, 6, 8},
                                                             {4, 6, 7, 8},
                                                             {6, 8, 9, 7},
                                                             {5, 6, 8, 9}}};
  std::array<Corners, 8> result;
  for (std::size_t i = 0; i < 8; ++i) {
    for (std::size_t k = 0; k < 4; ++k)
      result[i].row(static_cast<Eigen::Index>(k)) = p[parts[i][k]];
  }
  return result;
}

/// Subdivides only where the bound does not decide the sign yet.
double lower_bound(const Eigen::MatrixX3d& nodes, const Corners& corners, double scale, int depth) {
  const Bounds here = bounds_on(nodes, corners);
  const bool decided = here.coefficient > 0.0 || here.sample <= 0.0;
  if (decided || depth == 0 || here.sample - here.coefficient < 1e-3 * scale) {
    return here.sample <= 0.0 ? here.sample : here.coefficient;
  }
  double least = std::numeric_limits<double>::infinity();
  for (const Corners& part : subdivided(corners)) {
    least = std::min(least, lower_bound(nodes, part, scale, depth - 1));
  }
  return least;
}

JacobianRange curved_tetrahedron(const Eigen::MatrixX3d& nodes) {
  Corners corners;
  corners << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1;
  const Bounds whole = bounds_on(nodes, corners);
  if (whole.coefficient > 0.0 || whole.sample <= 0.0) {
    return {whole.coefficient > 0.0 ? whole.coefficient : whole.sample, whole.largest};
  }
  return {lower_bound(nodes, corners, whole.largest - whole.coefficient, 5), whole.largest};
}

Eigen::MatrixX3d nodes_of(const Eigen::MatrixX3d& nodes, const ElementBlock& block,
                          Eigen::Index element) {
  Eigen::MatrixX3d own(block.connectivity.cols(), 3);
  for (Eigen::Index a = 0; a < own.rows(); ++a)
    own.row(a) = nodes.row(block.connectivity(element, a));
  return own;
}

/// Eleven places along every edge, corners included: an edge's extremum lies between neighbours.
std::vector<Eigen::Vector3d> sample_points(ElementType type) {
  constexpr int n = 10;
  // The determinant at the apex of a pyramid depends on the side it is reached from.
  constexpr double before_apex = 1.0 - 1e-6;
  if (type == ElementType::tet4) return {Eigen::Vector3d::Zero()};  // the same everywhere
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n; ++j) {
      for (int k = 0; k <= n; ++k) {
        const Eigen::Vector3d share = Eigen::Vector3d(i, j, k) / n;
        const Eigen::Vector3d cube = 2.0 * share - Eigen::Vector3d::Ones();
        if (solid(type) == Solid::wedge) {
          if (i + j <= n) points.emplace_back(share[0], share[1], cube[2]);
        } else if (solid(type) == Solid::pyramid) {
          const double up = std::min(share[2], before_apex);
          points.emplace_back((1.0 - up) * cube[0], (1.0 - up) * cube[1], up);
        } else {
          points.push_back(cube);
        }
      }
    }
  }
  return points;
}

using Gradients = decltype(ElementShapes::gradients);

const std::vector<Gradients>& sampled_gradients(ElementType type) {
  static const auto tables = [] {
    std::array<std::vector<Gradients>, all_element_types.size()> all;
    for (const ElementType each : all_element_types) {
      for (const Eigen::Vector3d& xi : sample_points(each)) {
        all[static_cast<std::size_t>(each)].push_back(shapes(each, xi).gradients);
      }
    }
    return all;
  }();
  return tables[static_cast<std::size_t>(type)];
}

struct FacePoint {
  FaceShapes shapes;
  double weight;
};

/// Three Gauss points per direction, on triangles collapsed: for x·(x_ξ × x_η) on curved faces, of
/// degree 5 per direction on quadrilaterals and 4 on triangles.
std::vector<FacePoint> face_points(FaceType type) {
  constexpr std::array<double, 3> x{-0.77459666924148337704, 0.0, 0.77459666924148337704};
  constexpr std::array<double, 3> w{5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0};
  const bool triangle = n_corners(type) == 3;
  std::vector<FacePoint> points;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const double along = 0.5 * (1.0 + x[i]);
      const Eigen::Vector2d xi = triangle
                                     ? Eigen::Vector2d(along, 0.5 * (1.0 - along) * (1.0 + x[j]))
                                     : Eigen::Vector2d(x[i], x[j]);
      points.push_back({shapes(type, xi), w[i] * w[j] * (triangle ? 0.25 * (1.0 - along) : 1.0)});
    }
  }
  return points;
}

/// ∫ x·n dA over one face seen from outside: by Gauss's theorem the faces of a body sum to 3 V.
double flux_of_position(FaceType type, const Eigen::MatrixX3d& nodes) {
  static const auto tables = [] {
    std::array<std::vector<FacePoint>, all_face_types.size()> all;
    for (const FaceType each : all_face_types) {
      all[static_cast<std::size_t>(each)] = face_points(each);
    }
    return all;
  }();
  double flux = 0.0;
  for (const FacePoint& point : tables[static_cast<std::size_t>(type)]) {
    const Eigen::Vector3d x = nodes.transpose() * point.shapes.values;
    const Eigen::Matrix<double, 3, 2> tangents = nodes.transpose() * point.shapes.gradients;
    flux += point.weight * x.dot(tangents.col(0).cross(tangents.col(1)));
  }
  return flux;
}

// Of the cube of an element's size: the determinant of a flat element is rounding of products of
// lengths.
constexpr double flat = 1e-14;

double size_of(const Eigen::MatrixX3d& nodes) {
  return (nodes.colwise().maxCoeff() - nodes.colwise().minCoeff()).norm();
}

/// "12, 17, 31, …": the first few.
std::string some(const std::vector<std::int64_t>& tags) {
  std::ostringstream text;
  for (std::size_t i = 0; i < std::min<std::size_t>(tags.size(), 8); ++i) {
    text << (i > 0 ? ", " : "") << tags[i];
  }
  if (tags.size() > 8) text << ", …";
  return text.str();
}

}  // namespace

JacobianRange jacobian_range(ElementType type, const Eigen::MatrixX3d& nodes) {
  if (type == ElementType::tet10) return curved_tetrahedron(nodes);
  JacobianRange range{std::numeric_limits<double>::infinity(),
                      -std::numeric_limits<double>::infinity()};
  for (const Gradients& gradients : sampled_gradients(type)) {
    const double value = Eigen::Matrix3d(nodes.transpose() * gradients).determinant();
    range.least = std::min(range.least, value);
    range.largest = std::max(range.largest, value);
  }
  return range;
}

double element_volume(ElementType type, const Eigen::MatrixX3d& nodes) {
  const Eigen::MatrixX3d from_first = nodes.rowwise() - nodes.row(0);  // spares rounding far away
  const auto table = faces(type);
  double volume = 0.0;
  for (std::size_t f = 0; f < table.size(); ++f) {
    volume += flux_of_position(face_type(type, f), from_first(table[f], Eigen::all)) / 3.0;
  }
  return volume;
}

void check_elements(const Eigen::MatrixX3d& nodes, const std::vector<ElementBlock>& elements) {
  std::vector<std::int64_t> inverted;
  double worst = std::numeric_limits<double>::infinity();
  Eigen::Index n_elements = 0;
  Eigen::Index n_negative = 0;  // everywhere
  for (const ElementBlock& block : elements) {
    n_elements += block.connectivity.rows();
    for (Eigen::Index e = 0; e < block.connectivity.rows(); ++e) {
      const Eigen::MatrixX3d own = nodes_of(nodes, block, e);
      const JacobianRange range = jacobian_range(block.type, own);
      if (range.least > flat * std::pow(size_of(own), 3)) continue;
      inverted.push_back(block.tags[static_cast<std::size_t>(e)]);
      if (range.largest <= 0.0) ++n_negative;
      if (range.largest > 0.0) worst = std::min(worst, range.least / range.largest);
    }
  }
  if (inverted.empty()) return;
  const bool all = static_cast<Eigen::Index>(inverted.size()) == n_elements;
  std::ostringstream text;
  text << "bad-mesh: " << inverted.size() << " of " << n_elements
       << (inverted.size() == 1 ? " elements is" : " elements are")
       << " inverted or flat (Jacobian not positive everywhere): "
       << (inverted.size() == 1 ? "element " : "elements ") << some(inverted);
  if (all && n_negative == n_elements) {
    text << "; all of them: the nodes are listed left-handed";
  } else if (all) {
    text << "; all of them in part: are the mid-edge nodes in the order of gmsh?";
  } else if (n_negative > 0) {
    text << "; " << n_negative
         << " of them inside out: is the file damaged, or their order of nodes not that of the "
            "format? Write it once more";
  } else if (worst < std::numeric_limits<double>::infinity()) {
    text << "; worst ratio of smallest to largest Jacobian " << worst
         << "; are the mid-edge nodes where they belong? Else mesh with smaller elements, or "
            "optimise the curved elements";
  }
  throw MeshError(text.str());
}

void check_coincident_nodes(const Eigen::MatrixX3d& nodes) {
  if (nodes.rows() < 2) return;
  const Eigen::RowVector3d extent = nodes.colwise().maxCoeff() - nodes.colwise().minCoeff();
  const double tolerance = 1e-9 * extent.norm();
  // Along a direction no mesh is aligned with, nodes that are near each other are near in order.
  const Eigen::Vector3d direction = Eigen::Vector3d(0.5132, 0.6180, 0.5957).normalized();
  const Eigen::VectorXd position = nodes * direction;
  std::vector<Eigen::Index> order(static_cast<std::size_t>(nodes.rows()));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  std::sort(order.begin(), order.end(),
            [&](Eigen::Index a, Eigen::Index b) { return position[a] < position[b]; });
  Eigen::Index pairs = 0;
  Eigen::Index first = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    for (std::size_t j = i + 1;
         j < order.size() && position[order[j]] - position[order[i]] <= tolerance; ++j) {
      if ((nodes.row(order[i]) - nodes.row(order[j])).norm() > tolerance) continue;
      if (pairs++ == 0) first = order[i];
    }
  }
  if (pairs == 0) return;
  // Fewer than a face has corners: bodies that touch with a mesh each, which meet in places only.
  const bool touch = pairs < 3;
  const char* const remedy =
      touch ? "parts that touch there are not joined, and merging these nodes would not join them: "
              "give the parts a common mesh (gmsh: BooleanFragments, CAD: one body)"
            : "merge duplicate nodes before export";
  std::ostringstream text;
  text << "bad-mesh: " << counted(pairs, "pair of nodes coincides", "pairs of nodes coincide")
       << " but " << (pairs == 1 ? "is" : "are") << " not joined, the first at ("
       << nodes.row(first) << ") m; " << remedy;
  throw MeshError(text.str());
}

void check_connected(Eigen::Index n_nodes, const std::vector<ElementBlock>& elements,
                     const Eigen::MatrixX3d& nodes) {
  std::vector<Eigen::Index> parent(static_cast<std::size_t>(n_nodes));
  std::iota(parent.begin(), parent.end(), Eigen::Index{0});
  const auto root = [&](Eigen::Index i) {
    while (parent[static_cast<std::size_t>(i)] != i) {
      auto& up = parent[static_cast<std::size_t>(i)];
      up = parent[static_cast<std::size_t>(up)];
      i = up;
    }
    return i;
  };
  for (const ElementBlock& block : elements) {
    for (Eigen::Index e = 0; e < block.connectivity.rows(); ++e) {
      const Eigen::Index first = root(block.connectivity(e, 0));
      for (const Eigen::Index node : block.connectivity.row(e)) {
        parent[static_cast<std::size_t>(root(node))] = first;
      }
    }
  }
  std::map<Eigen::Index, Eigen::Index> sizes;
  for (Eigen::Index i = 0; i < n_nodes; ++i) ++sizes[root(i)];
  if (sizes.size() == 1) return;
  const auto smallest = std::min_element(
      sizes.begin(), sizes.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  std::ostringstream text;
  text << "bad-mesh: the mesh has " << sizes.size()
       << " parts that do not hang together; the smallest has "
       << counted(smallest->second, "node", "nodes") << ", near (" << nodes.row(smallest->first)
       << ") m";
  throw MeshError(text.str());
}

}  // namespace microslip::mesh
