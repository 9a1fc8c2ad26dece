#include "fem/surface_load.hpp"

#include <algorithm>

#include <Eigen/Geometry>

#include "fem/quadrature.hpp"
#include "mesh/shape_functions.hpp"

namespace microslip::fem {
namespace {

// Exact on plane faces (N_i times a constant or, on distorted quadrilaterals, cubic Jacobian) and
// far below the discretisation on curved ones.
constexpr int degree = 5;

// Adds ∫ N_i dA of the faces of one type to the mesh nodes.
void add_block(const Eigen::MatrixX3d& nodes, const mesh::FaceBlock& block, Eigen::VectorXd& area) {
  const QuadratureRule rule = face_rule(block.type, degree);
  for (Eigen::Index point = 0; point < rule.weights.size(); ++point) {
    const Eigen::Vector2d xi = rule.points.row(point).head<2>().transpose();
    const Eigen::VectorXd values = mesh::shape_values(block.type, xi);
    const Eigen::MatrixX2d gradients = mesh::shape_gradients(block.type, xi);
    for (Eigen::Index face = 0; face < block.connectivity.rows(); ++face) {
      Eigen::Matrix<double, 3, 2> tangents = Eigen::Matrix<double, 3, 2>::Zero();
      for (Eigen::Index i = 0; i < values.size(); ++i) {
        tangents += nodes.row(block.connectivity(face, i)).transpose() * gradients.row(i);
      }
      const double dA = rule.weights[point] * tangents.col(0).cross(tangents.col(1)).norm();
      for (Eigen::Index i = 0; i < values.size(); ++i) {
        area[block.connectivity(face, i)] += dA * values[i];
      }
    }
  }
}

}  // namespace

Eigen::VectorXd nodal_areas(const Eigen::MatrixX3d& nodes, const mesh::Surface& surface) {
  Eigen::VectorXd area = Eigen::VectorXd::Zero(nodes.rows());
  for (const mesh::FaceBlock& block : surface.faces) add_block(nodes, block, area);
  return area(surface.nodes);
}

Eigen::MatrixXd traction_loads(const Eigen::MatrixX3d& nodes, const mesh::Surface& surface,
                               const Eigen::Matrix3d& frame) {
  const Eigen::VectorXd area = nodal_areas(nodes, surface);
  Eigen::MatrixXd loads = Eigen::MatrixXd::Zero(3 * nodes.rows(), 3);
  for (std::size_t i = 0; i < surface.nodes.size(); ++i) {
    loads.middleRows<3>(3 * surface.nodes[i]) = area[static_cast<Eigen::Index>(i)] * frame.transpose();
  }
  return loads;
}

}  // namespace microslip::fem
