/// @file
/// Signs that the errors of sampled forces lead a walk along a branch: folds closer to each other
/// than such forces can tell, as they turn the branch more than once where it turns, and steps by
/// the hundred.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "solver/response_curve.hpp"

namespace microslip::solver {

class SampledWalk {
 public:
  /// @param point  the next one of the branch.
  void add(const ResponsePoint& point);
  /// Two folds in succession were within 3e-5 of the frequency and 3 % of the amplitude, or there
  /// were more than 500 points.
  [[nodiscard]] bool is_led_by_errors() const;

 private:
  struct Fold {
    double frequency;  // [rad/s]
    double amplitude;  // [m]
  };
  std::optional<Fold> last_;
  bool close_folds_ = false;
  std::size_t n_points_ = 0;
};

/// The same of a whole branch.
[[nodiscard]] bool is_led_by_errors(std::span<const ResponsePoint> branch);

}  // namespace microslip::solver
