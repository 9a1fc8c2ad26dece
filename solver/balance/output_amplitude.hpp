/// @file
/// Size of the output over a period: half its peak-to-peak value,
/// with the derivative by the unknowns.
#pragma once

#include <Eigen/Core>

#include "contact/harmonics.hpp"

namespace microslip::solver {

struct OutputAmplitude {
  double half_peak_to_peak = 0.0;  ///< [m]; for one harmonic hypot(y_s, y_c)
  double first_harmonic = 0.0;     ///< [m]
  double mean = 0.0;               ///< [m]
  double phase = 0.0;              ///< atan2(y_c, y_s) of the first harmonic [rad]
  Eigen::VectorXd gradient;  ///< ∂(half_peak_to_peak)/∂x, in the order of Harmonics::vector()
};

/// @param output  y = output · q, n_modes.
[[nodiscard]] OutputAmplitude output_amplitude(const contact::Harmonics& q,
                                               const Eigen::VectorXd& output);

}  // namespace microslip::solver
