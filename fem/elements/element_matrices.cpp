#include "fem/elements/element_matrices.hpp"

#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include <Eigen/LU>

#include "fem/elements/number_text.hpp"
#include "fem/elements/quadrature.hpp"
#include "mesh/shape_functions.hpp"

namespace microslip::fem {
namespace {

template <int n>
using NodeMatrix = Eigen::Matrix<double, n, 3>;

// Shape functions and their reference gradients at the points of one rule.
template <int n>
struct RuleTable {
  QuadratureRule rule;
  std::vector<Eigen::Matrix<double, n, 1>> values;
  std::vector<NodeMatrix<n>> gradients;

  RuleTable(mesh::ElementType type, QuadratureRule given) : rule(std::move(given)) {
    for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
      const Eigen::Vector3d xi = rule.points.row(q).transpose();
      const mesh::ElementShapes shapes = mesh::shapes(type, xi);
      values.emplace_back(shapes.values);
      gradients.emplace_back(shapes.gradients);
    }
  }
};

// S = ∫ g gᵀ dV, g the gradients of all shape functions, node after node.
template <int n>
using GradientProducts = Eigen::Matrix<double, 3 * n, 3 * n>;

template <int n>
GradientProducts<n> gradient_products(const RuleTable<n>& table, const NodeMatrix<n>& nodes) {
  constexpr int batch = 4;  // points per matrix product: keeps the update out of memory traffic
  GradientProducts<n> S = GradientProducts<n>::Zero();
  Eigen::Matrix<double, 3 * n, batch> G;
  Eigen::Matrix<double, 3 * n, batch> weighted;
  int filled = 0;
  const Eigen::Index n_points = table.rule.weights.size();
  for (Eigen::Index q = 0; q < n_points; ++q) {
    const NodeMatrix<n>& reference = table.gradients[static_cast<std::size_t>(q)];
    const Eigen::Matrix3d jacobian = reference.transpose() * nodes;  // ∂x_j/∂ξ_i
    const Eigen::Matrix<double, 3, n> g = jacobian.inverse() * reference.transpose();
    G.col(filled) = g.reshaped();
    weighted.col(filled) = (table.rule.weights[q] * jacobian.determinant()) * g.reshaped();
    if (++filled == batch || q + 1 == n_points) {
      G.rightCols(batch - filled).setZero();
      weighted.rightCols(batch - filled).setZero();
      S.noalias() += weighted.lazyProduct(G.transpose());
      filled = 0;
    }
  }
  return S;
}

template <int n>
void stiffness_from_products(const GradientProducts<n>& S, const LameConstants& lame,
                             ElementMatrices& result) {
  for (int i = 0; i < n; ++i) {
    for (int j = i; j < n; ++j) {
      const Eigen::Matrix3d s = S.template block<3, 3>(3 * i, 3 * j);
      Eigen::Matrix3d k = lame.lambda * s + lame.mu * s.transpose();
      k.diagonal().array() += lame.mu * s.trace();
      if (i == j) k = (0.5 * (k + k.transpose())).eval();  // symmetric to the last bit
      result.stiffness.template block<3, 3>(3 * i, 3 * j) = k;
      result.stiffness.template block<3, 3>(3 * j, 3 * i) = k.transpose();
    }
  }
}

template <int n>
void mass_matrix(const RuleTable<n>& table, const NodeMatrix<n>& nodes, double density,
                 ElementMatrices& result) {
  Eigen::Matrix<double, n, n> m = Eigen::Matrix<double, n, n>::Zero();
  for (std::size_t q = 0; q < table.values.size(); ++q) {
    const Eigen::Matrix3d jacobian = table.gradients[q].transpose() * nodes;
    const double dm =
        density * table.rule.weights[static_cast<Eigen::Index>(q)] * jacobian.determinant();
    m.noalias() += (dm * table.values[q]).lazyProduct(table.values[q].transpose());
  }
  result.mass = 0.5 * (m + m.transpose());
}

template <int n>
void integrate(const RuleTable<n>& stiffness, const RuleTable<n>& mass, const NodeMatrix<n>& nodes,
               const Material& material, ElementMatrices& result) {
  result.stiffness.resize(3 * n, 3 * n);
  stiffness_from_products<n>(gradient_products<n>(stiffness, nodes), LameConstants(material),
                             result);
  mass_matrix<n>(mass, nodes, material.density, result);
}

// Edge nodes in the middle of their edges, to 1e-12 of the edge: what is left then changes K by
// less than rounding does.
bool has_straight_edges(const Eigen::MatrixX3d& nodes) {
  constexpr std::array<std::array<int, 2>, 6> edges{
      {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}}};
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const Eigen::RowVector3d a = nodes.row(edges[e][0]);
    const Eigen::RowVector3d b = nodes.row(edges[e][1]);
    const Eigen::RowVector3d off = nodes.row(4 + static_cast<Eigen::Index>(e)) - 0.5 * (a + b);
    if (off.norm() > 1e-12 * (b - a).norm()) return false;
  }
  return true;
}

bool takes_four_points(const Eigen::MatrixX3d& nodes, Tet10Rule rule) {
  return rule == Tet10Rule::four_point || has_straight_edges(nodes);
}

const QuadratureRule& tet10_stiffness_rule(bool four_points) {
  static const QuadratureRule four_point = tetrahedron_rule(2);
  static const QuadratureRule fourteen_point = tetrahedron_rule(5);
  return four_points ? four_point : fourteen_point;
}

void tet10_matrices(const Eigen::MatrixX3d& nodes, const Material& material, Tet10Rule rule,
                    ElementMatrices& result) {
  constexpr auto type = mesh::ElementType::tet10;
  static const RuleTable<10> four_point(type, tet10_stiffness_rule(true));
  static const RuleTable<10> fourteen_point(type, tet10_stiffness_rule(false));
  static const RuleTable<10> straight_mass(type, tetrahedron_rule(4));
  static const RuleTable<10> curved_mass(type, tetrahedron_rule(7));  // N_i N_j: 4, det J: 3
  if (rule == Tet10Rule::four_point) {
    return integrate<10>(four_point, four_point, nodes, material, result);
  }
  const bool straight = has_straight_edges(nodes);
  integrate<10>(straight ? four_point : fourteen_point, straight ? straight_mass : curved_mass,
                nodes, material, result);
}

}  // namespace

const QuadratureRule& stiffness_rule(mesh::ElementType type, const Eigen::MatrixX3d& nodes,
                                     Tet10Rule rule) {
  using mesh::ElementType;
  static const QuadratureRule tet4 = tetrahedron_rule(0);
  static const QuadratureRule hex8 = hexahedron_rule(2);
  static const QuadratureRule hex20 = hexahedron_rule(3);
  static const QuadratureRule wedge6 = wedge_rule(2, 2);
  static const QuadratureRule wedge15 = wedge_rule(4, 3);
  static const QuadratureRule pyramid5 = pyramid_rule(2);
  static const QuadratureRule pyramid13 = pyramid_rule(3);
  switch (type) {
    case ElementType::tet4:
      return tet4;
    case ElementType::tet10:
      return tet10_stiffness_rule(takes_four_points(nodes, rule));
    case ElementType::hex8:
      return hex8;
    case ElementType::hex20:
      return hex20;
    case ElementType::wedge6:
      return wedge6;
    case ElementType::wedge15:
      return wedge15;
    case ElementType::pyramid5:
      return pyramid5;
    case ElementType::pyramid13:
      return pyramid13;
  }
  throw std::invalid_argument("no element type of this number");
}

void element_matrices(mesh::ElementType type, const Eigen::MatrixX3d& nodes,
                      const Material& material, Tet10Rule rule, ElementMatrices& result) {
  using mesh::ElementType;
  switch (type) {
    case ElementType::tet4: {
      static const RuleTable<4> stiffness(type, stiffness_rule(type, nodes, rule));
      static const RuleTable<4> mass(type, tetrahedron_rule(2));
      return integrate<4>(stiffness, mass, nodes, material, result);
    }
    case ElementType::tet10:
      return tet10_matrices(nodes, material, rule, result);
    case ElementType::hex8: {
      static const RuleTable<8> stiffness(type, stiffness_rule(type, nodes, rule));
      static const RuleTable<8> mass(type,
                                     hexahedron_rule(3));  // per direction N_i N_j: 2, det J: 2
      return integrate<8>(stiffness, mass, nodes, material, result);
    }
    case ElementType::hex20: {
      static const RuleTable<20> stiffness(type, stiffness_rule(type, nodes, rule));
      static const RuleTable<20> mass(type,
                                      hexahedron_rule(5));  // per direction N_i N_j: 4, det J: 5
      return integrate<20>(stiffness, mass, nodes, material, result);
    }
    case ElementType::wedge6: {
      static const RuleTable<6> stiffness(type, stiffness_rule(type, nodes, rule));
      static const RuleTable<6> mass(type, wedge_rule(3, 3));  // N_i N_j: 2 and 2, det J: 1 and 2
      return integrate<6>(stiffness, mass, nodes, material, result);
    }
    case ElementType::wedge15: {
      static const RuleTable<15> stiffness(type, stiffness_rule(type, nodes, rule));
      static const RuleTable<15> mass(type, wedge_rule(8, 5));  // N_i N_j: 4 and 4, det J: 4 and 5
      return integrate<15>(stiffness, mass, nodes, material, result);
    }
    case ElementType::pyramid5: {
      static const RuleTable<5> stiffness(type, stiffness_rule(type, nodes, rule));
      static const RuleTable<5> mass(type, pyramid_rule(3));  // N_i N_j: 2, det J: 2 in a and b
      return integrate<5>(stiffness, mass, nodes, material, result);
    }
    case ElementType::pyramid13: {
      static const RuleTable<13> stiffness(type, stiffness_rule(type, nodes, rule));
      static const RuleTable<13> mass(type, pyramid_rule(5));  // N_i N_j: 4, det J: 5 in a and b
      return integrate<13>(stiffness, mass, nodes, material, result);
    }
  }
}

void check_material(const Material& material) {
  const auto refuse = [](const char* what, double value, const char* range) {
    throw std::invalid_argument(std::string(what) + " = " + number_text(value) + " is not " +
                                range);
  };
  const auto positive = [](double value) { return std::isfinite(value) && value > 0.0; };
  if (!positive(material.youngs_modulus)) {
    refuse("Young's modulus", material.youngs_modulus, "a finite number > 0 Pa");
  }
  if (!(material.poissons_ratio > -1.0 && material.poissons_ratio < 0.5)) {
    refuse("Poisson's ratio", material.poissons_ratio, "in (-1, 0.5)");
  }
  if (!positive(material.density))
    refuse("density", material.density, "a finite number > 0 kg/m^3");
}

}  // namespace microslip::fem
