/// @file
/// A response curve by pseudo-arclength continuation with Newton–GMRES, and its peaks.
#pragma once

#include <functional>
#include <vector>

#include "tests/verification/truth/balance.hpp"

namespace microslip::truth {

struct CurvePoint {
  Eigen::VectorXd x;       ///< unknowns of the balance [m]
  double omega = 0.0;      ///< [rad/s]
  double amplitude = 0.0;  ///< half peak-to-peak of the output [m]
  double first_harmonic = 0.0;
  int newton = 0;  ///< iterations it took
  int gmres = 0;
};

struct CurveOptions {
  double from_hz = 285.0;
  double to_hz = 340.0;
  double largest_step = 0.4;  ///< in units of (relative change of x, change of f / 5 Hz)
  double smallest_step = 1e-5;
  int most_points = 600;
  double tolerance = 1e-7;  ///< ‖R‖/‖x‖
  bool verbose = false;
};

struct Curve {
  std::vector<CurvePoint> points;
  std::vector<CurvePoint> peaks;  ///< refined local maxima of the amplitude, in order
  bool complete = false;
};

/// Follows the branch from from_hz until to_hz is reached; turns around folds.
[[nodiscard]] Curve trace(Balance& balance, const CurveOptions& options);

/// Newton at fixed ω from x. @throws std::runtime_error  no convergence.
[[nodiscard]] CurvePoint solve_at(Balance& balance, const Eigen::VectorXd& x, double omega,
                                  double tolerance);

}  // namespace microslip::truth
