/// @file
/// A signal between two instants: the cubic with the slopes that its neighbours give at both ends,
/// as the kernels have it (lanes/line_kernels.cpp). From one step to the next it is C¹; its error
/// is of third order in the step.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "contact/lanes/block_size.hpp"

namespace microslip::contact::sampled {

struct StepSpline {
  double begin, slope, square, cube;

  /// @param w  at four instants, the step between the second and the third.
  explicit StepSpline(const std::array<double, 4>& w) {
    const double rise = w[2] - w[1];
    const double m1 = 0.5 * (w[2] - w[0]);
    const double m2 = 0.5 * (w[3] - w[1]);
    begin = w[1];
    slope = m1;
    square = 3.0 * rise - 2.0 * m1 - m2;
    cube = m1 + m2 - 2.0 * rise;
  }
  [[nodiscard]] StepSpline negated() const {
    StepSpline result = *this;
    for (double* number : {&result.begin, &result.slope, &result.square, &result.cube}) {
      *number = -*number;
    }
    return result;
  }
  /// w + factor r.
  [[nodiscard]] StepSpline plus(double factor, const StepSpline& r) const {
    StepSpline sum = *this;
    sum.begin += factor * r.begin;
    sum.slope += factor * r.slope;
    sum.square += factor * r.square;
    sum.cube += factor * r.cube;
    return sum;
  }
  /// x in [0, 1].
  [[nodiscard]] double at(double x) const { return begin + x * (slope + x * (square + x * cube)); }
  [[nodiscard]] double slope_at(double x) const {
    return slope + x * (2.0 * square + 3.0 * x * cube);
  }
  [[nodiscard]] double bend_at(double x) const { return 2.0 * square + 6.0 * x * cube; }
  /// Where it has its top, of side 1, or its bottom, of −1.
  [[nodiscard]] double turn(double side) const {
    const double root = std::sqrt(std::max(square * square - 3.0 * slope * cube, 0.0));
    const double below = root - side * square;
    return below == 0.0 ? 0.0 : std::clamp(side * slope / below, 0.0, 1.0);
  }
  /// Where a signal that rises through 0 does so, by Newton's method from the chord.
  [[nodiscard]] double rise_through_zero(double chord) const {
    double x = -begin / chord;
    for (int i = 0; i < 2; ++i) {
      x = std::clamp(x - at(x) / std::max(slope_at(x), 0.25 * chord), 0.0, 1.0);
    }
    return x;
  }
  /// ∂w(x)/∂w at the four instants.
  [[nodiscard]] static std::array<double, 4> shares(double x) {
    const double out = 0.5 * x * (1.0 - x) * (1.0 - x);
    const double in = 0.5 * x * x * (x - 1.0);
    const double blend = x * x * (3.0 - 2.0 * x);
    return {-out, 1.0 - blend - in, blend + out, in};
  }
  /// ∂w'(x)/∂w.
  [[nodiscard]] static std::array<double, 4> slope_shares(double x) {
    const double out = 0.5 * (1.0 - x) * (1.0 - 3.0 * x);
    const double in = 0.5 * x * (3.0 * x - 2.0);
    const double blend = 6.0 * x * (1.0 - x);
    return {-out, -blend - in, blend + out, in};
  }
  /// ∂w''(x)/∂w.
  [[nodiscard]] static constexpr std::array<double, 4> bend_shares(double x) {
    return {2.0 - 3.0 * x, 9.0 * x - 5.0, 4.0 - 9.0 * x, 3.0 * x - 1.0};
  }
  /// ∂w'''/∂w.
  static constexpr std::array<double, 4> third_shares{-3.0, 9.0, -9.0, 3.0};
};

/// The four instants around the step that ends at `now` of n.
[[nodiscard]] inline std::array<std::size_t, 4> instants_around(std::size_t now, std::size_t n) {
  const std::size_t before = now > 0 ? now - 1 : n - 1;
  return {before > 0 ? before - 1 : n - 1, before, now, now + 1 < n ? now + 1 : 0};
}

/// Of a column of a block, there.
[[nodiscard]] inline std::array<double, 4> around_step(const double* column, std::size_t now,
                                                       std::size_t n) {
  const std::array<std::size_t, 4> at = instants_around(now, n);
  return {column[at[0] * block_size], column[at[1] * block_size], column[at[2] * block_size],
          column[at[3] * block_size]};
}

}  // namespace microslip::contact::sampled
