/// @file
/// The best value of one scene parameter: minimum over the parameter of the highest solved peak.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "solver/continuation.hpp"

namespace microslip::solver {

struct PeakOfParameter {
  double parameter = 0.0;
  double frequency = 0.0;  ///< [rad/s]
  double amplitude = 0.0;  ///< [m]
};

struct Optimum {
  PeakOfParameter best;
  std::vector<PeakOfParameter> trace;  ///< all peaks solved, sorted by parameter
  bool found = false;                  ///< false: minimum at an end of the bracket, or peaks not found
  /// Found: the interval that is as good to 1 % among the peaks solved, and minima nearly as good
  /// elsewhere; else why not.
  std::string message;
  long iterations = 0;
  long contact_evaluations = 0;
};

struct OptimumOptions {
  double lower = 0.0;  ///< bracket of the parameter, > 0: searched on a logarithmic scale
  double upper = 0.0;
  double relative_tolerance = 1e-4;  ///< of the parameter
  int n_scan = 12;                   ///< points of the first scan
};

/// @param family  scene for a value of the parameter.
[[nodiscard]] Optimum minimise_peak(const std::function<Scene(double)>& family,
                                    const ContinuationOptions& range,
                                    const OptimumOptions& options);

}  // namespace microslip::solver
