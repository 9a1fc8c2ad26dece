/// @file
/// A value and its derivative along one direction, carried through the same statements.
#pragma once

#include <cmath>

namespace microslip::truth {

struct Dual {
  double value = 0.0;
  double rate = 0.0;
  Dual() = default;
  Dual(double v, double r = 0.0) : value(v), rate(r) {}  // NOLINT: a number is a constant
};

inline Dual operator+(Dual a, Dual b) { return {a.value + b.value, a.rate + b.rate}; }
inline Dual operator-(Dual a, Dual b) { return {a.value - b.value, a.rate - b.rate}; }
inline Dual operator*(Dual a, Dual b) {
  return {a.value * b.value, a.value * b.rate + a.rate * b.value};
}
inline Dual operator/(Dual a, Dual b) {
  return {a.value / b.value, (a.rate - a.value / b.value * b.rate) / b.value};
}
inline Dual hypot(Dual a, Dual b) {
  const double size = std::hypot(a.value, b.value);
  return {size, size > 0.0 ? (a.value * a.rate + b.value * b.rate) / size : 0.0};
}

inline double value_of(double x) { return x; }
inline double value_of(Dual x) { return x.value; }

}  // namespace microslip::truth
