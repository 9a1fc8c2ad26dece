/// @file
/// Which harmonics of a motion are unknowns: the mean always, because contact shifts it, and any
/// set of orders k ≥ 1. Harmonics left out are zero.
#pragma once

#include <vector>

namespace microslip::solver {

class HarmonicSet {
 public:
  /// 1 … highest; a whole number stands for it. @throws std::invalid_argument  highest < 1.
  HarmonicSet(int highest);  // NOLINT(google-explicit-constructor)
  /// @param orders  in any order, each ≥ 1, at least one.
  /// @throws std::invalid_argument  empty, or an order below 1.
  explicit HarmonicSet(std::vector<int> orders);

  [[nodiscard]] int highest() const { return orders_.back(); }
  [[nodiscard]] int count() const { return static_cast<int>(orders_.size()); }
  /// Ascending, each once.
  [[nodiscard]] const std::vector<int>& orders() const { return orders_; }
  [[nodiscard]] bool contains(int order) const;
  /// No order is left out below the highest.
  [[nodiscard]] bool complete() const { return count() == highest(); }
  [[nodiscard]] HarmonicSet united(const std::vector<int>& orders) const;

  friend bool operator==(const HarmonicSet&, const HarmonicSet&) = default;

 private:
  std::vector<int> orders_;
};

}  // namespace microslip::solver
