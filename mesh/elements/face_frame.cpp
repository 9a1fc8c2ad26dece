#include "mesh/face_frame.hpp"

#include <Eigen/Geometry>

namespace microslip::mesh {

Eigen::Matrix3d axes_at(const Eigen::Vector3d& normal, const Eigen::Vector3d& slip_direction) {
  const Eigen::Vector3d p = (slip_direction - normal * normal.dot(slip_direction)).normalized();
  Eigen::Matrix3d axes;
  axes.row(0) = p;
  axes.row(1) = normal;
  axes.row(2) = p.cross(normal);
  return axes;
}

}  // namespace microslip::mesh
