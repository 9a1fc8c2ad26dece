#include "fem/surface_load.hpp"

#include <Eigen/Geometry>

#include "fem/quadrature.hpp"
#include "mesh/shape_functions.hpp"

namespace microslip::fem {

Eigen::MatrixXd uniform_tractions(const Eigen::MatrixX3d& nodes, const mesh::Surface& surface,
                                  const Eigen::Matrix3d& frame) {
  Eigen::VectorXd shares = Eigen::VectorXd::Zero(nodes.rows());  // ∫ N_a dA
  for (const mesh::FaceBlock& block : surface.faces) {
    for (const QuadraturePoint& point : face_rule(block.type)) {
      const auto shapes = mesh::shapes(block.type, Eigen::Vector2d(point.position.head<2>()));
      for (Eigen::Index f = 0; f < block.connectivity.rows(); ++f) {
        Eigen::Matrix<double, 3, 2> tangents = Eigen::Matrix<double, 3, 2>::Zero();
        for (Eigen::Index a = 0; a < block.connectivity.cols(); ++a) {
          tangents += nodes.row(block.connectivity(f, a)).transpose() * shapes.gradients.row(a);
        }
        const double area = point.weight * tangents.col(0).cross(tangents.col(1)).norm();
        for (Eigen::Index a = 0; a < block.connectivity.cols(); ++a) {
          shares[block.connectivity(f, a)] += area * shapes.values[a];
        }
      }
    }
  }
  Eigen::MatrixXd loads = Eigen::MatrixXd::Zero(3 * nodes.rows(), 3);
  for (const Eigen::Index node : surface.nodes) {
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      loads.col(axis).segment<3>(3 * node) = shares[node] * frame.row(axis).transpose();
    }
  }
  return loads;
}

}  // namespace microslip::fem
