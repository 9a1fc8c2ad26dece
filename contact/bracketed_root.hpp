/// @file
/// Root of a continuous function between two points where its sign differs: regula falsi with the
/// weight of a stale end halved (Illinois), and bisection where that is slow; or Newton's method.
#pragma once

#include <cmath>

namespace microslip::contact {

/// @param f          function of one number.
/// @param low, high  ends of the bracket; f(low) and f(high) have opposite signs or one is zero.
/// @param tolerance  of the point: it is returned once two guesses differ by no more; 0 for the
///                   rounding of `low` and `high`.
/// @return a point where f changes sign.
template <typename Function>
[[nodiscard]] double bracketed_root(const Function& f, double low, double high, double f_low,
                                    double f_high, double tolerance = 0.0) {
  if (f_low == 0.0) return low;
  if (f_high == 0.0) return high;
  for (int i = 0; i < 200; ++i) {
    const double width = high - low;
    const double size = std::abs(low) + std::abs(high);
    if (std::abs(width) <= 2e-16 * size) break;  // neighbouring doubles
    double middle = high - f_high * (width / (f_high - f_low));
    const bool inside = (middle - low) * (high - middle) > 0.0;
    if (!inside || i % 3 == 2) middle = 0.5 * (low + high);
    if (middle == low || middle == high) break;
    if (std::abs(middle - high) <= tolerance) return middle;
    const double f_middle = f(middle);
    if (f_middle == 0.0) return middle;
    if ((f_middle > 0.0) == (f_high > 0.0)) {
      f_low *= 0.5;
    } else {
      low = high;
      f_low = f_high;
    }
    high = middle;
    f_high = f_middle;
  }
  return high;
}

/// The same by Newton's method kept inside the bracket, for a function that knows its rate.
/// @param f  returns {value, rate}.
template <typename Function>
[[nodiscard]] double bracketed_newton(const Function& f, double low, double high, double f_low,
                                      double f_high, double tolerance = 0.0) {
  if (f_low == 0.0) return low;
  if (f_high == 0.0) return high;
  double x = high - f_high * ((high - low) / (f_high - f_low));
  for (int i = 1; i < 200; ++i) {
    const auto [value, rate] = f(x);
    if (value == 0.0) return x;
    ((value > 0.0) == (f_high > 0.0) ? high : low) = x;
    const double rounding = 2e-16 * std::abs(x);
    if (std::abs(high - low) <= rounding) break;
    double next = x - value / rate;
    const bool inside = (next - low) * (high - next) > 0.0;
    if (inside && std::abs(next - x) <= std::fmax(tolerance, rounding)) return next;
    if (!inside || i % 8 == 0) next = 0.5 * (low + high);
    if (next == low || next == high) break;
    x = next;
  }
  return x;
}

}  // namespace microslip::contact
