/// @file
/// Steady rotation of a body with its supports.
#pragma once

#include <Eigen/Core>

namespace microslip::fem {

struct Rotation {
  double speed = 0.0;                                    ///< Ω [rad/s], ≥ 0
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();      ///< a point of the axis [m]
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();  ///< of the axis, unit vector
};

}  // namespace microslip::fem
