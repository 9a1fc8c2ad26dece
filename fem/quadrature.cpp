#include "fem/quadrature.hpp"

#include <array>
#include <cmath>

namespace microslip::fem {
namespace {

QuadratureRule tetrahedron_4() {
  const double a = (5.0 - std::sqrt(5.0)) / 20.0;
  const double b = 1.0 - 3.0 * a;
  const double w = 1.0 / 24.0;
  return {{{a, a, a}, w}, {{b, a, a}, w}, {{a, b, a}, w}, {{a, a, b}, w}};
}

QuadratureRule tetrahedron_14() {
  QuadratureRule rule;
  const auto add_vertex_orbit = [&](double a, double w) {
    const double b = 1.0 - 3.0 * a;
    for (const Eigen::Vector3d& x : {Eigen::Vector3d(a, a, a), Eigen::Vector3d(b, a, a),
                                     Eigen::Vector3d(a, b, a), Eigen::Vector3d(a, a, b)}) {
      rule.push_back({x, w / 6.0});
    }
  };
  add_vertex_orbit(0.31088591926330060980, 0.11268792571801585080);
  add_vertex_orbit(0.092735250310891226402, 0.073493043116361949544);
  const double a = 0.045503704125649649492;
  const double b = 0.5 - a;
  for (const Eigen::Vector3d& x :
       {Eigen::Vector3d(a, a, b), Eigen::Vector3d(a, b, a), Eigen::Vector3d(b, a, a),
        Eigen::Vector3d(a, b, b), Eigen::Vector3d(b, a, b), Eigen::Vector3d(b, b, a)}) {
    rule.push_back({x, 0.042546020777081466438 / 6.0});
  }
  return rule;
}

struct Gauss {
  std::vector<double> x;
  std::vector<double> w;
};

Gauss gauss(int n) {
  if (n == 2) return {{-1.0 / std::sqrt(3.0), 1.0 / std::sqrt(3.0)}, {1.0, 1.0}};
  const double x = std::sqrt(0.6);
  return {{-x, 0.0, x}, {5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0}};
}

QuadratureRule hexahedron(int n) {
  const Gauss g = gauss(n);
  QuadratureRule rule;
  for (std::size_t i = 0; i < g.x.size(); ++i) {
    for (std::size_t j = 0; j < g.x.size(); ++j) {
      for (std::size_t k = 0; k < g.x.size(); ++k) {
        rule.push_back({{g.x[i], g.x[j], g.x[k]}, g.w[i] * g.w[j] * g.w[k]});
      }
    }
  }
  return rule;
}

QuadratureRule quadrilateral_9() {
  const Gauss g = gauss(3);
  QuadratureRule rule;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) rule.push_back({{g.x[i], g.x[j], 0.0}, g.w[i] * g.w[j]});
  }
  return rule;
}

/// Seven points, degree 5 (Radon).
QuadratureRule triangle_7() {
  const double root = std::sqrt(15.0);
  QuadratureRule rule{{{1.0 / 3.0, 1.0 / 3.0, 0.0}, 9.0 / 80.0}};
  for (const double sign : {-1.0, 1.0}) {
    const double a = (6.0 + sign * root) / 21.0;
    const double w = (155.0 + sign * root) / 2400.0;
    const double b = 1.0 - 2.0 * a;
    rule.push_back({{a, a, 0.0}, w});
    rule.push_back({{b, a, 0.0}, w});
    rule.push_back({{a, b, 0.0}, w});
  }
  return rule;
}

}  // namespace

const QuadratureRule& stiffness_rule(mesh::ElementType type, StiffnessRule rule) {
  static const QuadratureRule tet_4 = tetrahedron_4();
  static const QuadratureRule tet_14 = tetrahedron_14();
  static const QuadratureRule hex_8 = hexahedron(2);
  static const QuadratureRule hex_27 = hexahedron(3);
  switch (type) {
    case mesh::ElementType::tet4:
      return tet_4;
    case mesh::ElementType::tet10:
      return rule == StiffnessRule::accurate ? tet_14 : tet_4;
    case mesh::ElementType::hex8:
      return hex_8;
    case mesh::ElementType::hex20:
      return hex_27;
  }
  return tet_14;
}

const QuadratureRule& mass_rule(mesh::ElementType type) {
  // The accurate stiffness rules are exact to degree 4 (tet10) and 5 per axis (hex20); linear elements
  // have a mass of degree 2, which theirs carry.
  return stiffness_rule(type, StiffnessRule::accurate);
}

const QuadratureRule& face_rule(mesh::FaceType type) {
  static const QuadratureRule triangle = triangle_7();
  static const QuadratureRule quadrilateral = quadrilateral_9();
  const bool three_sided = type == mesh::FaceType::tri3 || type == mesh::FaceType::tri6;
  return three_sided ? triangle : quadrilateral;
}

}  // namespace microslip::fem
