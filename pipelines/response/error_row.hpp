/// @file
/// What one choice of the discretisation does to one number a user reads:
/// a row of the error budget.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "pipelines/description/goal_names.hpp"

namespace microslip::pipelines {

/// Of all peaks and folds of a curve, the one that moves most; no part of a bar.
inline constexpr const char* marked_amplitude_goal = "marked_amplitude";
inline constexpr const char* marked_frequency_goal = "marked_frequency";
/// Of an effect that is left out, along a whole curve, and not relative to anything: the number of
/// the table of effects.
inline constexpr const char* largest_indicator_goal = "largest_indicator";
/// Of an effect that is left out, where a curve has no peak within its range: of the resonance
/// nearest to the range, and of the amplitude at the end that is highest. No part of a bound.
inline constexpr const char* resonance_goal = "resonance";
inline constexpr const char* end_amplitude_goal = "end_amplitude";
/// Of the frequency of a peak that leaves the range with such an effect.
inline constexpr const char* peak_outside_goal = "peak_outside";
/// Of a motion integrated in time, at the frequency where it is largest, as all others take too
/// long.
inline constexpr const char* one_frequency_goal = "one_frequency";
/// At a point beside the peaks where such an indicator is above its threshold: of the amplitude
/// there, over the highest of the curve, beyond what the change of the peak itself makes there.
inline constexpr const char* amplitude_there_goal = "amplitude_there";
/// Of an amplitude at its frequency, over the highest of the curve, with what the change of the
/// peak makes there: the largest of a sample. No part of a bar.
inline constexpr const char* along_curve_goal = "along_curve";
inline constexpr const char* optimum_name = "optimum";  ///< in place of a curve's, of a best value

enum class ErrorKind : std::uint8_t {
  estimated,
  solved,  ///< with the richer model
  /// From the curve of the same study where it is largest: this one could not be followed.
  borrowed,
};

struct ErrorRow {
  std::string curve;  ///< its name, or "optimum"
  std::string goal;   ///< one of the above, or of goal_names.hpp
  /// Mesh, basis, cells, fit, harmonics, second_direction, instants, newton, eigensolver; of
  /// motions integrated in time steps, frequencies.
  std::string source;
  double effect =
      0.0;  ///< relative, signed: what would be added with the source refined to its end
  ErrorKind kind = ErrorKind::estimated;
  double seconds = 0.0;   ///< of the refined solution
  double where_hz = 0.0;  ///< of an indicator along a curve: where it is largest; of a point
};

/// An effect that is left out, and why nothing says what it would change.
struct NoBound {
  std::string effect;
  std::string why;  ///< ends a sentence
};

/// All sources of one goal together: Σ |effect|, relative half width.
[[nodiscard]] inline double bar_of(const std::vector<ErrorRow>& rows, const std::string& curve,
                                   const std::string& goal) {
  double bar = 0.0;
  for (const ErrorRow& row : rows) {
    if (row.curve == curve && row.goal == goal) bar += row.effect < 0.0 ? -row.effect : row.effect;
  }
  return bar;
}

}  // namespace microslip::pipelines
