/// @file
/// LU factors of a small square matrix with pivots by rows. Loops of a length that is known beat
/// those of general factors several times.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include <Eigen/Core>

namespace microslip::contact {

template <int n>
class StageFactor {
 public:
  void compute(const Eigen::Matrix<double, n, n>& matrix) {
    factors_ = matrix;
    for (int i = 0; i < n; ++i) row_[at(i)] = i;
    for (int k = 0; k < n; ++k) {
      bring_pivot(k);
      for (int i = k + 1; i < n; ++i) {
        const double share = factors_(i, k) /= factors_(k, k);
        for (int j = k + 1; j < n; ++j) factors_(i, j) -= share * factors_(k, j);
      }
    }
  }

  /// @param b, x  n rows each, any number of columns; not the same.
  template <typename Right, typename Left>
  void solve(const Right& b, Left& x) const {
    for (int i = 0; i < n; ++i) {
      x.row(i) = b.row(row_[at(i)]);
      for (int k = 0; k < i; ++k) x.row(i) -= factors_(i, k) * x.row(k);
    }
    for (int i = n - 1; i >= 0; --i) {
      for (int k = i + 1; k < n; ++k) x.row(i) -= factors_(i, k) * x.row(k);
      x.row(i) /= factors_(i, i);
    }
  }

 private:
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }

  void bring_pivot(int k) {
    int largest = k;
    for (int i = k + 1; i < n; ++i) {
      if (std::abs(factors_(i, k)) > std::abs(factors_(largest, k))) largest = i;
    }
    if (largest == k) return;
    factors_.row(k).swap(factors_.row(largest));
    std::swap(row_[at(k)], row_[at(largest)]);
  }

  Eigen::Matrix<double, n, n, Eigen::RowMajor> factors_ =
      Eigen::Matrix<double, n, n, Eigen::RowMajor>::Identity();
  std::array<int, static_cast<std::size_t>(n)> row_{};
};

}  // namespace microslip::contact
