/// @file
/// The face model integrated in time: the same structure and the same law of the points as the
/// balance, without harmonics. Each shape is solved exactly for a force that is linear over a step
/// (Nigam & Jennings, Bull. Seism. Soc. Am. 59 (1969) 909–922),
///
///   q_{i+1} = a q_i + b q̇_i/ω + c p_i + d p_{i+1},    p = φᵀF − Φ_f F_c,
///
/// so that the motion of the face at the end of a step is X + Φ_fᵀ d Φ_f F_c(X) = X₀, solved by
/// Newton's method. No shape is damped by the integration; those far above the step answer at rest.
/// Errors are O(h²).
#pragma once

#include <Eigen/Core>

#include "tests/verification/truth/balance.hpp"

namespace microslip::truth {

struct TimeOptions {
  int steps = 1024;  ///< per period of the excitation
  int most_periods = 400;
  double steady = 1e-6;   ///< relative change of the amplitude from period to period, thrice
  double spacing = 2e-4;  ///< of frequencies about a peak, relative
};

struct TimeResult {
  double half_peak_to_peak = 0.0;  ///< at A along x, of the last period [m]
  double change = 0.0;             ///< over the last ten periods, relative
  int periods = 0;
};

/// The top of a parabola through the three highest of evenly spaced frequencies.
struct TimePeak {
  double amplitude = 0.0;  ///< [m]; 0: it was not enclosed
  double omega = 0.0;      ///< [rad/s]
  double change = 0.0;     ///< the largest of the three
  int periods = 0;         ///< of all frequencies
};

/// From the motion of a balance, at its frequency.
/// @param shapes  Balance::shapes() of the solution.   @param omega  [rad/s]
/// @throws std::runtime_error  a step has no solution.
[[nodiscard]] TimeResult integrate(const FaceModel& model, const ContactConstants& contact,
                                   bool planar, const Eigen::MatrixXd& shapes, double omega,
                                   const TimeOptions& options);

/// The peak near that of a balance; every frequency is begun from the motion of the balance.
[[nodiscard]] TimePeak peak_in_time(const FaceModel& model, const ContactConstants& contact,
                                    bool planar, const Eigen::MatrixXd& shapes, double omega,
                                    const TimeOptions& options);

}  // namespace microslip::truth
