#include "fem/elements/polynomial_tractions.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "fem/elements/quadrature.hpp"
#include "mesh/shape_functions.hpp"

namespace microslip::fem {
namespace {

/// Calls visit(x, dA, N, nodes of the face, outward normal) at every quadrature point of the
/// surface.
template <typename Visit>
void for_each_point(const Eigen::MatrixX3d& nodes, const mesh::Surface& surface, int degree,
                    const Visit& visit) {
  for (const mesh::FaceBlock& block : surface.faces) {
    const QuadratureRule rule = face_rule(block.type, degree);
    for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
      const Eigen::Vector2d xi = rule.points.row(q).head<2>().transpose();
      const auto [N, dN] = mesh::shapes(block.type, xi);
      for (Eigen::Index face = 0; face < block.connectivity.rows(); ++face) {
        Eigen::Vector3d x = Eigen::Vector3d::Zero();
        Eigen::Matrix<double, 3, 2> tangents = Eigen::Matrix<double, 3, 2>::Zero();
        for (Eigen::Index i = 0; i < N.size(); ++i) {
          const Eigen::Vector3d node = nodes.row(block.connectivity(face, i)).transpose();
          x += N[i] * node;
          tangents += node * dN.row(i);
        }
        const Eigen::Vector3d normal = tangents.col(0).cross(tangents.col(1));
        visit(x, rule.weights[q] * normal.norm(), N, block.connectivity.row(face),
              normal.normalized());
      }
    }
  }
}

constexpr double dependent = 1e-9;  // of a polynomial's square: what others leave of it

/// Centroid and the two in-plane principal directions, each divided by √3 of its second moment: a
/// rectangle becomes the square [−1, 1]².
struct PatchAxes {
  Eigen::Vector3d centroid;
  Eigen::Matrix<double, 2, 3> scaled;
};

/// Onto the mean plane of a surface; a closed one has none and keeps all directions.
Eigen::Matrix3d mean_plane(const Eigen::MatrixX3d& nodes, const mesh::Surface& surface,
                           int degree) {
  constexpr double least_normal = 0.1;  // mean of unit normals
  double area = 0.0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for_each_point(nodes, surface, degree,
                 [&](auto&&, double dA, auto&&, auto&&, const Eigen::Vector3d& normal) {
                   area += dA;
                   sum += dA * normal;
                 });
  if (sum.norm() < least_normal * area) return Eigen::Matrix3d::Identity();
  const Eigen::Vector3d normal = sum.normalized();
  return Eigen::Matrix3d::Identity() - normal * normal.transpose();
}

/// @param is_curved  its mean plane, and not its two largest extents, tells the axes:
///                   a narrow arc is higher than wide.
PatchAxes patch_axes(const Eigen::MatrixX3d& nodes, const mesh::Surface& surface, bool is_curved) {
  constexpr int degree = 8;  // as for the areas: exact on flat faces
  double area = 0.0;
  Eigen::Vector3d first = Eigen::Vector3d::Zero();
  for_each_point(nodes, surface, degree,
                 [&](const Eigen::Vector3d& x, double dA, auto&&, auto&&, auto&&) {
                   area += dA;
                   first += dA * x;
                 });
  const Eigen::Vector3d centroid = first / area;
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  for_each_point(nodes, surface, degree,
                 [&](const Eigen::Vector3d& x, double dA, auto&&, auto&&, auto&&) {
                   second += dA / area * (x - centroid) * (x - centroid).transpose();
                 });
  if (is_curved) {
    const Eigen::Matrix3d plane = mean_plane(nodes, surface, degree);
    second = (plane * second * plane).eval();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(second);
  if (!(eigen.eigenvalues()[1] > 1e-12 * eigen.eigenvalues()[2])) {
    throw std::invalid_argument("surface \"" + surface.name + "\" has no area to carry a traction");
  }
  const Eigen::Vector2d width = (3.0 * eigen.eigenvalues().tail<2>()).cwiseSqrt();
  return {centroid,
          width.cwiseInverse().asDiagonal() * eigen.eigenvectors().rightCols<2>().transpose()};
}

/// P_0 … P_degree at x.
Eigen::VectorXd legendre(double x, int degree) {
  Eigen::VectorXd P(degree + 1);
  P[0] = 1.0;
  if (degree > 0) P[1] = x;
  for (int n = 2; n <= degree; ++n) {
    P[n] = ((2 * n - 1) * x * P[n - 1] - (n - 1) * P[n - 2]) / n;
  }
  return P;
}

Eigen::VectorXd products_at(const Eigen::Vector2d& xi, int degree) {
  const Eigen::VectorXd P = legendre(xi[0], degree);
  const Eigen::VectorXd Q = legendre(xi[1], degree);
  Eigen::VectorXd values(n_polynomials(degree));
  Eigen::Index k = 0;
  for (int total = 0; total <= degree; ++total) {
    for (int i = 0; i <= total; ++i) values[k++] = P[total - i] * Q[i];
  }
  return values;
}

/// ∫ P_k P_l dA.
/// @param add  add(node, N_i dA, P, normal), at every quadrature point: for ∫ N_i P_k dA.
template <typename Add>
Eigen::MatrixXd gram_matrix(const Eigen::MatrixX3d& nodes, const mesh::Surface& surface, int degree,
                            bool is_curved, const Add& add) {
  const PatchAxes axes = patch_axes(nodes, surface, is_curved);
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(n_polynomials(degree), n_polynomials(degree));
  for_each_point(nodes, surface, std::max(8, 2 * degree + 2),
                 [&](const Eigen::Vector3d& x, double dA, const Eigen::VectorXd& N,
                     const auto& face, const Eigen::Vector3d& normal) {
                   const Eigen::VectorXd P = products_at(axes.scaled * (x - axes.centroid), degree);
                   gram += dA * P * P.transpose();
                   for (Eigen::Index i = 0; i < N.size(); ++i) add(face[i], dA * N[i], P, normal);
                 });
  return gram;
}

/// One after the other, those that depend on lower ones left as zero:
/// x² + y² on a cylinder is a constant.
Eigen::MatrixXd orthonormal_of_dependent(const Eigen::MatrixXd& gram,
                                         const Eigen::MatrixXd& shares) {
  Eigen::MatrixXd combined = Eigen::MatrixXd::Zero(gram.rows(), gram.cols());  // t = combined P
  for (Eigen::Index k = 0; k < gram.rows(); ++k) {
    Eigen::VectorXd t = Eigen::VectorXd::Unit(gram.rows(), k);
    for (int pass = 0; pass < 2; ++pass) {  // the second removes what rounding left of the first
      t -= (combined.transpose() * (combined * (gram * t))).eval();
    }
    const double square = t.dot(gram * t);
    if (square > dependent * gram(k, k)) combined.row(k) = t / std::sqrt(square);
  }
  return shares * combined.transpose();
}

/// P = L t, so t = L⁻¹P keeps the order of degree. @param shares  a column for each P.
Eigen::MatrixXd orthonormal(const Eigen::MatrixXd& gram, const Eigen::MatrixXd& shares) {
  const Eigen::LLT<Eigen::MatrixXd> cholesky(gram);
  const Eigen::ArrayXd pivots = cholesky.matrixLLT().diagonal().array().square();
  if (cholesky.info() != Eigen::Success || !(pivots > dependent * gram.diagonal().array()).all()) {
    return orthonormal_of_dependent(gram, shares);
  }
  return cholesky.matrixL().solve(shares.transpose()).transpose();
}

Eigen::MatrixXd plane_tractions(const Eigen::MatrixX3d& nodes, const mesh::Surface& surface,
                                const Eigen::Matrix3d& frame, int degree) {
  const Eigen::Index n = n_polynomials(degree);
  Eigen::MatrixXd shares = Eigen::MatrixXd::Zero(nodes.rows(), n);
  const Eigen::MatrixXd gram =
      gram_matrix(nodes, surface, degree, false,
                  [&](Eigen::Index node, double weight, const Eigen::VectorXd& P,
                      const Eigen::Vector3d&) { shares.row(node) += weight * P.transpose(); });
  shares = orthonormal(gram, shares);
  Eigen::MatrixXd loads(3 * nodes.rows(), 3 * n);
  for (Eigen::Index i = 0; i < nodes.rows(); ++i) {
    for (Eigen::Index k = 0; k < n; ++k) {
      loads.block<3, 3>(3 * i, 3 * k) = shares(i, k) * frame.transpose();
    }
  }
  return loads;
}

Eigen::MatrixXd local_tractions(const Eigen::MatrixX3d& nodes, const mesh::Surface& surface,
                                const mesh::FaceFrame& frame, int degree) {
  const Eigen::Index n = n_polynomials(degree);
  Eigen::MatrixXd loads = Eigen::MatrixXd::Zero(3 * nodes.rows(), 3 * n);
  const Eigen::MatrixXd gram = gram_matrix(
      nodes, surface, degree, true,
      [&](Eigen::Index node, double weight, const Eigen::VectorXd& P, const Eigen::Vector3d& at) {
        const Eigen::Matrix3d along = weight * frame.at(at).transpose();
        for (Eigen::Index k = 0; k < n; ++k) loads.block<3, 3>(3 * node, 3 * k) += P[k] * along;
      });
  for (const Eigen::Index axis : {0, 1, 2}) {
    const auto own = Eigen::seqN(axis, n, Eigen::fix<3>);
    loads(Eigen::all, own) = orthonormal(gram, loads(Eigen::all, own)).eval();
  }
  return loads;
}

}  // namespace

Eigen::MatrixXd polynomial_tractions(const Eigen::MatrixX3d& nodes, const mesh::Surface& surface,
                                     const mesh::FaceFrame& frame, int degree) {
  if (degree < 0) {
    throw std::invalid_argument("degree of the tractions = " + std::to_string(degree) +
                                ", at least 0");
  }
  return frame.is_local() ? local_tractions(nodes, surface, frame, degree)
                          : plane_tractions(nodes, surface, frame.plane, degree);
}

}  // namespace microslip::fem
