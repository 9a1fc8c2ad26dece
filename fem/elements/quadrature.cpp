#include "fem/elements/quadrature.hpp"

#include <cmath>

#include "fem/elements/symmetric_pairs.hpp"

namespace microslip::fem {
namespace {

// Coefficients of the three-term recurrence of the monic Jacobi polynomials (alpha, 0).
Eigen::MatrixXd jacobi_matrix(int n, double alpha) {
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(n, n);
  for (int k = 0; k < n; ++k) {
    const double s = 2.0 * k + alpha;
    J(k, k) = s == 0.0 ? 0.0 : -alpha * alpha / (s * (s + 2.0));
    if (k == 0) continue;
    const double product = 4.0 * k * k * (k + alpha) * (k + alpha);
    J(k, k - 1) = J(k - 1, k) = std::sqrt(product / (s * s * (s + 1.0) * (s - 1.0)));
  }
  return J;
}

// Orbits of the symmetric group of the tetrahedron in barycentric coordinates (a, a, a, 1 − 3a).
void append_vertex_orbit(double a, double weight, QuadratureRule& rule, Eigen::Index& at) {
  const Eigen::Vector4d base(a, a, a, 1.0 - 3.0 * a);
  for (int k = 0; k < 4; ++k) {
    Eigen::Vector4d barycentric = base;
    std::swap(barycentric[k], barycentric[3]);
    rule.points.row(at) = barycentric.head<3>().transpose();
    rule.weights[at++] = weight;
  }
}

// (a, a, ½ − a, ½ − a) and its permutations: one point per edge.
void append_edge_orbit(double a, double weight, QuadratureRule& rule, Eigen::Index& at) {
  for (int i = 0; i < 4; ++i) {
    for (int j = i + 1; j < 4; ++j) {
      Eigen::Vector4d barycentric = Eigen::Vector4d::Constant(0.5 - a);
      barycentric[i] = barycentric[j] = a;
      rule.points.row(at) = barycentric.head<3>().transpose();
      rule.weights[at++] = weight;
    }
  }
}

QuadratureRule tetrahedron_4_points() {
  QuadratureRule rule{Eigen::MatrixX3d(4, 3), Eigen::VectorXd(4)};
  Eigen::Index at = 0;
  append_vertex_orbit((5.0 - std::sqrt(5.0)) / 20.0, 1.0 / 24.0, rule, at);
  return rule;
}

QuadratureRule tetrahedron_14_points() {
  QuadratureRule rule{Eigen::MatrixX3d(14, 3), Eigen::VectorXd(14)};
  Eigen::Index at = 0;
  append_vertex_orbit(0.31088591926330060980, 0.11268792571801585080 / 6.0, rule, at);
  append_vertex_orbit(0.092735250310891226402, 0.073493043116361949544 / 6.0, rule, at);
  append_edge_orbit(0.045503704125649649492, 0.042546020777081466438 / 6.0, rule, at);
  return rule;
}

// Orbit (a, a, 1 − 2a) of the triangle.
void append_triangle_orbit(double a, double weight, QuadratureRule& rule, Eigen::Index& at) {
  const double b = 1.0 - 2.0 * a;
  rule.points.middleRows<3>(at) << a, a, 0.0, b, a, 0.0, a, b, 0.0;
  rule.weights.segment<3>(at).setConstant(weight);
  at += 3;
}

QuadratureRule triangle_3_points() {
  QuadratureRule rule{Eigen::MatrixX3d(3, 3), Eigen::VectorXd(3)};
  Eigen::Index at = 0;
  append_triangle_orbit(1.0 / 6.0, 1.0 / 6.0, rule, at);
  return rule;
}

QuadratureRule triangle_6_points() {
  QuadratureRule rule{Eigen::MatrixX3d(6, 3), Eigen::VectorXd(6)};
  Eigen::Index at = 0;
  append_triangle_orbit(0.44594849091596488632, 0.22338158967801146570 / 2.0, rule, at);
  append_triangle_orbit(0.091576213509770743460, 0.10995174365532186764 / 2.0, rule, at);
  return rule;
}

// ξ = x, η = y(1 − x), ζ = z(1 − x)(1 − y): the Jacobian (1 − x)²(1 − y) becomes Jacobi weights.
QuadratureRule collapsed_tetrahedron(int n) {
  const QuadratureRule x = gauss_jacobi(n, 2.0);
  const QuadratureRule y = gauss_jacobi(n, 1.0);
  const QuadratureRule z = gauss_jacobi(n, 0.0);
  QuadratureRule rule{Eigen::MatrixX3d(n * n * n, 3), Eigen::VectorXd(n * n * n)};
  Eigen::Index at = 0;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      for (int k = 0; k < n; ++k, ++at) {
        const double xi = 0.5 * (1.0 + x.points(i, 0));
        const double eta = 0.5 * (1.0 + y.points(j, 0)) * (1.0 - xi);
        const double zeta = 0.5 * (1.0 + z.points(k, 0)) * (1.0 - xi - eta);
        rule.points.row(at) << xi, eta, zeta;
        rule.weights[at] =
            x.weights[i] * y.weights[j] * z.weights[k] / 64.0;  // halves: 2³ · 2² · 2
      }
    }
  }
  return rule;
}

}  // namespace

QuadratureRule gauss_jacobi(int n, double alpha) {
  const SymmetricPairs eigen = symmetric_pairs(jacobi_matrix(n, alpha));
  const double total = std::pow(2.0, alpha + 1.0) / (alpha + 1.0);
  QuadratureRule rule{Eigen::MatrixX3d::Zero(n, 3), Eigen::VectorXd(n)};
  rule.points.col(0) = eigen.values;
  rule.weights = total * eigen.vectors.row(0).transpose().cwiseAbs2();
  return rule;
}

QuadratureRule tetrahedron_rule(int degree) {
  if (degree <= 2) return tetrahedron_4_points();
  if (degree <= 5) return tetrahedron_14_points();
  return collapsed_tetrahedron(degree / 2 + 1);
}

QuadratureRule triangle_rule(int degree) {
  if (degree <= 2) return triangle_3_points();
  if (degree <= 4) return triangle_6_points();
  const int n = degree / 2 + 1;
  const QuadratureRule x = gauss_jacobi(n, 1.0);
  const QuadratureRule y = gauss_jacobi(n, 0.0);
  QuadratureRule rule{Eigen::MatrixX3d::Zero(n * n, 3), Eigen::VectorXd(n * n)};
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const double xi = 0.5 * (1.0 + x.points(i, 0));
      rule.points(i * n + j, 0) = xi;
      rule.points(i * n + j, 1) = 0.5 * (1.0 + y.points(j, 0)) * (1.0 - xi);
      rule.weights[i * n + j] = x.weights[i] * y.weights[j] / 8.0;
    }
  }
  return rule;
}

QuadratureRule hexahedron_rule(int n) {
  const QuadratureRule line = gauss_jacobi(n, 0.0);
  QuadratureRule rule{Eigen::MatrixX3d(n * n * n, 3), Eigen::VectorXd(n * n * n)};
  for (int at = 0; at < n * n * n; ++at) {
    const int i = at / (n * n);
    const int j = at / n % n;
    const int k = at % n;
    rule.points.row(at) << line.points(i, 0), line.points(j, 0), line.points(k, 0);
    rule.weights[at] = line.weights[i] * line.weights[j] * line.weights[k];
  }
  return rule;
}

QuadratureRule wedge_rule(int degree, int n) {
  const QuadratureRule triangle = triangle_rule(degree);
  const QuadratureRule line = gauss_jacobi(n, 0.0);
  const Eigen::Index n_triangle = triangle.weights.size();
  QuadratureRule rule{triangle.points.replicate(n, 1), triangle.weights.replicate(n, 1)};
  for (int i = 0; i < n; ++i) {
    rule.points.col(2).segment(i * n_triangle, n_triangle).setConstant(line.points(i, 0));
    rule.weights.segment(i * n_triangle, n_triangle) *= line.weights[i];
  }
  return rule;
}

// ξ = a(1 − ζ), η = b(1 − ζ): the Jacobian (1 − ζ)² becomes a Jacobi weight.
QuadratureRule pyramid_rule(int n) {
  const QuadratureRule base = square_rule(n);
  const QuadratureRule height = gauss_jacobi(n, 2.0);
  QuadratureRule rule{base.points.replicate(n, 1), base.weights.replicate(n, 1)};
  for (int i = 0; i < n; ++i) {
    const double zeta = 0.5 * (1.0 + height.points(i, 0));
    rule.points.middleRows(i * n * n, n * n) *= 1.0 - zeta;
    rule.points.col(2).segment(i * n * n, n * n).setConstant(zeta);
    rule.weights.segment(i * n * n, n * n) *= height.weights[i] / 8.0;  // halves: 2² · 2
  }
  return rule;
}

QuadratureRule square_rule(int n) {
  const QuadratureRule line = gauss_jacobi(n, 0.0);
  QuadratureRule rule{Eigen::MatrixX3d::Zero(n * n, 3), Eigen::VectorXd(n * n)};
  for (int at = 0; at < n * n; ++at) {
    rule.points(at, 0) = line.points(at / n, 0);
    rule.points(at, 1) = line.points(at % n, 0);
    rule.weights[at] = line.weights[at / n] * line.weights[at % n];
  }
  return rule;
}

QuadratureRule face_rule(mesh::FaceType type, int degree) {
  return mesh::n_corners(type) == 3 ? triangle_rule(degree) : square_rule(degree / 2 + 1);
}

}  // namespace microslip::fem
