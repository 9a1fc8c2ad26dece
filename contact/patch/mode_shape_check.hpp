/// @file
/// The check every force on a patch makes of the mode shapes it is given.
#pragma once

#include <Eigen/Core>

namespace microslip::contact {

/// @param owner  who asks, begins the message.   @param name  "u", "v" or "w".
/// @param shape  [1/√kg], expected rows × columns, finite.
/// @throws std::invalid_argument  another size, with both; or a value that is not finite.
void require_mode_shape(const char* owner, const char* name, const Eigen::MatrixXd& shape,
                        Eigen::Index rows, Eigen::Index columns);

}  // namespace microslip::contact
