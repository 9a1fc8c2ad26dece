/// @file
/// Amplitudes over the parameter about the lowest of them.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "solver/optimum.hpp"

namespace microslip::solver {

constexpr double as_good = 1.01;        ///< times the minimum
constexpr double nearly_as_low = 1.02;  ///< likewise, of minima elsewhere that are named

using Place = std::vector<PeakOfParameter>::const_iterator;

/// The values about the best one whose amplitude is at most `limit`: first and one past the last.
/// @param trace  sorted by parameter, `best` among them.
[[nodiscard]] std::array<Place, 2> below(const std::vector<PeakOfParameter>& trace,
                                         const PeakOfParameter& best, double limit);

/// How well the minimum is determined: the interval about it that is as good to 1 %, and other
/// minima as good to 2 %.
[[nodiscard]] std::string valley(const std::vector<PeakOfParameter>& trace,
                                 const PeakOfParameter& best);

/// For messages of a search that was stopped.
[[nodiscard]] std::string lowest_so_far(const PeakOfParameter& best);

/// A text and a number of six digits.
[[nodiscard]] std::string sentence(const char* text, double value);

/// A share of the scale as a distance of positions, which are parameters or their logarithms.
[[nodiscard]] double on_scale(const OptimumOptions& options, double share);

}  // namespace microslip::solver
