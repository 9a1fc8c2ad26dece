/// @file
/// The functions of the Fourier convention at one phase, and their derivatives (theory section 0).
#pragma once

#include <Eigen/Core>

namespace microslip::contact {

/// 1, sin θ, cos θ, sin 2θ, … (size 2H+1).
void trigonometric_basis(int n_harmonics, double phase, Eigen::VectorXd& value);
/// The derivative of the basis, from its values.
void basis_rate(const Eigen::VectorXd& value, Eigen::VectorXd& rate);

}  // namespace microslip::contact
