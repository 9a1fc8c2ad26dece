#include "fem/surface_load.hpp"

#include <Eigen/Geometry>

#include "fem/elements/quadrature.hpp"
#include "mesh/shape_functions.hpp"

namespace microslip::fem {
namespace {

// Exact on flat faces (N_i times det J: degree 4 at most per direction); on curved ones the root in
// dA is smooth and leaves about 1e-10.
constexpr int face_degree = 8;

/// Calls add(node, N_i, n dA) at every point of quadrature of every face; n outward.
template <typename Add>
void integrate_faces(const Eigen::MatrixX3d& nodes, const mesh::FaceBlock& block, const Add& add) {
  const QuadratureRule rule = face_rule(block.type, face_degree);
  for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
    const Eigen::Vector2d xi = rule.points.row(q).head<2>().transpose();
    const auto [N, dN] = mesh::shapes(block.type, xi);
    for (Eigen::Index face = 0; face < block.connectivity.rows(); ++face) {
      Eigen::Matrix<double, 3, 2> tangents = Eigen::Matrix<double, 3, 2>::Zero();
      for (Eigen::Index i = 0; i < N.size(); ++i) {
        tangents += nodes.row(block.connectivity(face, i)).transpose() * dN.row(i);
      }
      const Eigen::Vector3d area = rule.weights[q] * tangents.col(0).cross(tangents.col(1));
      for (Eigen::Index i = 0; i < N.size(); ++i) add(block.connectivity(face, i), N[i], area);
    }
  }
}

Eigen::MatrixX3d local_tractions(const Eigen::MatrixX3d& nodes, const mesh::Surface& surface,
                                 const mesh::FaceFrame& frame) {
  Eigen::MatrixX3d loads = Eigen::MatrixX3d::Zero(3 * nodes.rows(), 3);
  for (const mesh::FaceBlock& block : surface.faces) {
    integrate_faces(nodes, block, [&](Eigen::Index node, double N, const Eigen::Vector3d& area) {
      loads.middleRows<3>(3 * node) += N * area.norm() * frame.at(area.normalized()).transpose();
    });
  }
  return loads;
}

}  // namespace

Eigen::VectorXd nodal_areas(const Eigen::MatrixX3d& nodes, const mesh::Surface& surface) {
  Eigen::VectorXd areas = Eigen::VectorXd::Zero(nodes.rows());
  for (const mesh::FaceBlock& block : surface.faces) {
    integrate_faces(nodes, block, [&](Eigen::Index node, double N, const Eigen::Vector3d& area) {
      areas[node] += area.norm() * N;
    });
  }
  return areas;
}

Eigen::MatrixX3d uniform_tractions(const Eigen::MatrixX3d& nodes, const mesh::Surface& surface,
                                   const mesh::FaceFrame& frame) {
  if (frame.is_local()) return local_tractions(nodes, surface, frame);
  const Eigen::VectorXd areas = nodal_areas(nodes, surface);
  Eigen::MatrixX3d loads(3 * nodes.rows(), 3);
  for (Eigen::Index i = 0; i < nodes.rows(); ++i)
    loads.middleRows<3>(3 * i) = areas[i] * frame.plane.transpose();
  return loads;
}

Eigen::VectorXd normal_traction(const Eigen::MatrixX3d& nodes, const mesh::Surface& surface) {
  Eigen::VectorXd load = Eigen::VectorXd::Zero(3 * nodes.rows());
  for (const mesh::FaceBlock& block : surface.faces) {
    integrate_faces(nodes, block, [&](Eigen::Index node, double N, const Eigen::Vector3d& area) {
      load.segment<3>(3 * node) += N * area;
    });
  }
  return load;
}

}  // namespace microslip::fem
