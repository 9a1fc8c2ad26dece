/// @file
/// A bowed, sheared and tapered box: no edge of a quadratic element stays straight.
#pragma once

#include <Eigen/Core>

#include "fem/material.hpp"

namespace microslip::test {

inline const fem::Material titanium{1.14e11, 0.32, 4430.0};

inline Eigen::Vector3d bend(const Eigen::Vector3d& x) {
  return {x[0] + 0.2 * x[1] * x[1] + 0.1 * x[2], x[1] * (1.0 + 0.3 * x[0]) - 0.1 * x[0] * x[0],
          x[2] + 0.15 * x[0] * x[1] + 0.1 * x[2] * x[2]};
}

}  // namespace microslip::test
