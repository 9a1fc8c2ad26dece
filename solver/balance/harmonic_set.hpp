/// @file
/// Which harmonics of a motion are unknowns: the mean, unless nothing shifts it, and any set of
/// orders k ≥ 1. Harmonics left out are zero.
#pragma once

#include <vector>

namespace microslip::solver {

class HarmonicSet {
 public:
  /// Left out of forces that change sign with the motion (theory 13), and of linear ones that
  /// nothing static loads.
  enum class Mean { unknown, left_out };

  /// 1 … highest; a whole number stands for it. @throws std::invalid_argument  highest < 1.
  HarmonicSet(int highest);  // NOLINT(google-explicit-constructor)
  /// @param orders  in any order, each ≥ 1, at least one.
  /// @throws std::invalid_argument  empty, or an order below 1.
  explicit HarmonicSet(std::vector<int> orders, Mean mean = Mean::unknown);

  [[nodiscard]] int highest() const { return orders_.back(); }
  [[nodiscard]] int count() const { return static_cast<int>(orders_.size()); }
  /// Ascending, each once.
  [[nodiscard]] const std::vector<int>& orders() const { return orders_; }
  [[nodiscard]] bool contains(int order) const;
  [[nodiscard]] bool has_mean() const { return mean_ == Mean::unknown; }
  /// Neither the mean nor an order below the highest is left out.
  [[nodiscard]] bool complete() const { return has_mean() && count() == highest(); }
  /// With the mean if this has it.
  [[nodiscard]] HarmonicSet united(const std::vector<int>& orders) const;

  friend bool operator==(const HarmonicSet&, const HarmonicSet&) = default;

 private:
  std::vector<int> orders_;
  Mean mean_ = Mean::unknown;
};

}  // namespace microslip::solver
