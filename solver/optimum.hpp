/// @file
/// The best value of one scene parameter: minimum over the parameter of the largest amplitude on
/// the frequency range, its ends included. Peaks and ends are followed from value to value
/// (peak_trace.hpp); the best value itself is confirmed on a whole curve,
/// and where that keeps failing every value is.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "solver/optimum/peak_trace.hpp"

namespace microslip::solver {

/// Why a search has no best value.
enum class NotFound : std::uint8_t {
  none,                ///< there is one
  out_of_time,         ///< the search was stopped
  no_solution,         ///< for any value
  unsettled,           ///< higher peaks than those followed kept appearing
  flat,                ///< the smallest amplitude is that of many values
  at_bound,            ///< of the values searched
  no_solution_beside,  ///< there is none at the values beside the smallest amplitude
  incomplete_curve,    ///< at the smallest amplitude
  unsolved_peak,       ///< the same
  count                ///< of these
};

struct Optimum {
  PeakOfParameter best;
  std::vector<PeakOfParameter> trace;  ///< all values solved for, sorted by parameter
  bool found = false;  ///< false: minimum at a bound of the parameter, flat, or not confirmed
  /// Where the minimum does not depend on the parameter: the interval over which it is the same;
  /// `best` is then one of many.
  std::optional<std::array<double, 2>> flat;
  NotFound reason = NotFound::none;  ///< of `objection`
  std::string objection;             ///< why not found; empty: found
  /// The verdict: settled, or the objection; the interval that is as good to 1 % among the values
  /// solved for, minima nearly as good elsewhere, and whether an end of the frequency range counts.
  std::string message;
  std::vector<std::string> notes;     ///< see PeakTrace
  std::vector<std::string> warnings;  ///< likewise
  std::vector<int> orders;            ///< of the harmonics that it was searched with
  int n_curves = 0;                   ///< traced whole
  long iterations = 0;
  long contact_evaluations = 0;
  double seconds = 0.0;
  /// Of `best`, where its curve was traced with the harmonics of a corrected search; else nullptr.
  std::shared_ptr<const ResponseCurve> best_curve;
  /// What few harmonics have found first; nullptr: it was searched with as few, or stopped before.
  std::shared_ptr<const Optimum> by_few;
};

struct OptimumOptions {
  double lower = 0.0;  ///< bracket of the parameter; > 0 on the logarithmic scale
  double upper = 0.0;
  /// Of the parameter; on the linear scale of upper − lower.
  double relative_tolerance = 1e-4;
  /// Relative: amplitudes that close are the same (PeakTraceOptions). ≥ 1e-7
  double amplitude_tolerance = 1e-7;
  int n_scan = 12;  ///< values of the first scan, ≥ 3
  /// Where the best value is believed to be: the first scan begins with the curve there alone.
  std::optional<double> believed;
  ParameterScale scale = ParameterScale::logarithmic;
  /// Of a search for solutions beside the curve (ContinuationOptions::search_starts) at the best
  /// value and at both ends of the interval that is as good to 1 %; 0: none beside those the scene
  /// asks for. Where peaks need not be exact to rounding, with few harmonics; with all of them at
  /// the best value alone, and only where few have found some.
  int search_starts = 2;
  Together together = one_by_one;  ///< curves that do not wait for one another
};

/// @param family  scene for a value of the parameter; on whatever threads `together` runs its
///                tasks.
/// @throws std::invalid_argument  bounds or counts out of range.
[[nodiscard]] Optimum minimise_peak(const SceneFamily& family, const ContinuationOptions& range,
                                    const OptimumOptions& options);

}  // namespace microslip::solver
