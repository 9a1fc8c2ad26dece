#include "fem/elements/deformed_element.hpp"

#include <algorithm>

#include <Eigen/LU>

#include "mesh/shape_functions.hpp"

namespace microslip::fem {
namespace {

// What one point of integration adds to (2) and (3) but for Σ a aᵀ, which waits for its transposed
// blocks.
struct PointTerms {
  Eigen::Matrix3Xd a;                 // F g_i
  Eigen::Matrix3Xd force;             // F S g_i
  Eigen::Matrix3d left_cauchy_green;  // F Fᵀ
  Eigen::MatrixXd gradients;          // g_i·g_j
  Eigen::MatrixXd stresses;           // g_i·S g_j
  double strain;                      // ‖E‖
  double volume;                      // det F

  PointTerms(const Eigen::Matrix3Xd& g, const Eigen::MatrixX3d& displacement,
             const LameConstants& lame) {
    const Eigen::Matrix3d H = displacement.transpose() * g.transpose();  // ∇u
    const Eigen::Matrix3d F = Eigen::Matrix3d::Identity() + H;
    // ½(FᵀF − I) without the difference, in which small strains would be lost.
    const Eigen::Matrix3d E = 0.5 * (H + H.transpose() + H.transpose() * H);
    Eigen::Matrix3d S = 2.0 * lame.mu * E;
    S.diagonal().array() += lame.lambda * E.trace();
    a = F * g;
    force = F * (S * g);
    left_cauchy_green = F * F.transpose();
    gradients = g.transpose() * g;
    stresses = g.transpose() * (S * g);
    strain = E.norm();
    volume = F.determinant();
  }
};

void add_point(const PointTerms& point, double weight, double mu, NodeBlocks& tangent) {
  const Eigen::Index n = point.a.cols();
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      auto block = tangent.block<3, 3>(3 * i, 3 * j);
      block += (weight * mu * point.gradients(i, j)) * point.left_cauchy_green;
      block.diagonal().array() += weight * point.stresses(i, j);
    }
  }
}

// λ a_i a_jᵀ + μ a_j a_iᵀ, given the sum of all a aᵀ.
void add_products(const Eigen::MatrixXd& products, const LameConstants& lame, NodeBlocks& tangent) {
  for (Eigen::Index i = 0; i < products.rows(); i += 3) {
    for (Eigen::Index j = 0; j < products.cols(); j += 3) {
      const Eigen::Matrix3d s = products.block<3, 3>(i, j);
      tangent.block<3, 3>(i, j) += lame.lambda * s + lame.mu * s.transpose();
    }
  }
}

}  // namespace

void deform_element(mesh::ElementType type, const Eigen::MatrixX3d& nodes,
                    const Eigen::MatrixX3d& displacement, const Material& material, Tet10Rule rule,
                    DeformedElement& result) {
  const Eigen::Index n = nodes.rows();
  const LameConstants lame(material);
  const QuadratureRule& points = stiffness_rule(type, nodes, rule);
  result.force.setZero(3, n);
  result.tangent.setZero(3 * n, 3 * n);
  result.strain = 0.0;
  result.inside_out = false;
  Eigen::MatrixXd products = Eigen::MatrixXd::Zero(3 * n, 3 * n);
  for (Eigen::Index q = 0; q < points.weights.size(); ++q) {
    const Eigen::MatrixX3d reference =
        mesh::shapes(type, points.points.row(q).transpose()).gradients;
    const Eigen::Matrix3d jacobian = reference.transpose() * nodes;  // ∂x_j/∂ξ_i
    const PointTerms point(jacobian.inverse() * reference.transpose(), displacement, lame);
    const double weight = points.weights[q] * jacobian.determinant();
    result.force += weight * point.force;
    products.noalias() += (weight * point.a.reshaped()) * point.a.reshaped().transpose();
    add_point(point, weight, lame.mu, result.tangent);
    result.strain = std::max(result.strain, point.strain);
    result.inside_out = result.inside_out || !(point.volume > 0.0);
  }
  add_products(products, lame, result.tangent);
}

}  // namespace microslip::fem
