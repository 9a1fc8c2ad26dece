/// @file
/// The scale on which values of a parameter are spread and compared.
#pragma once

#include <cmath>

namespace microslip::solver {

enum class ParameterScale { logarithmic, linear };

/// Of a parameter: its logarithm, or itself. @param parameter  > 0 on the logarithmic scale.
[[nodiscard]] inline double position_on(ParameterScale scale, double parameter) {
  return scale == ParameterScale::logarithmic ? std::log(parameter) : parameter;
}

/// The parameter at a position.
[[nodiscard]] inline double parameter_at(ParameterScale scale, double position) {
  return scale == ParameterScale::logarithmic ? std::exp(position) : position;
}

}  // namespace microslip::solver
