/// @file
/// Fewer numbers than modes that move the patches of a contact.
#pragma once

#include <Eigen/Core>

namespace microslip::contact {

/// The motion of all patches by r numbers instead of those of N modes: x = of_modes · q moves them
/// as the modes motion · x do (theory 14.2). of_modes · motion = I.
struct MotionCoordinates {
  Eigen::MatrixXd of_modes;  ///< r × N
  Eigen::MatrixXd motion;    ///< N × r

  [[nodiscard]] bool all_modes() const { return of_modes.size() == 0; }
};

}  // namespace microslip::contact
