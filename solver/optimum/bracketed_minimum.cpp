#include "solver/optimum/bracketed_minimum.hpp"

#include <array>
#include <cmath>
#include <limits>

namespace microslip::solver {
namespace {

/// The minimum of a parabola through three points, relative to the first; infinite beyond `most`,
/// as where they lie on a line, and where a value is not known.
double parabola_step(const std::array<double, 3>& at, const std::array<double, 3>& value,
                     double most) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (!std::isfinite(value[0] + value[1] + value[2])) return infinity;
  const double r = (at[0] - at[1]) * (value[0] - value[2]);
  const double q = (at[0] - at[2]) * (value[0] - value[1]);
  const double twice = (at[0] - at[1]) * r - (at[0] - at[2]) * q;
  const double bend = q - r;
  const bool near = std::abs(twice) < 2.0 * most * std::abs(bend);
  return near ? 0.5 * twice / bend : infinity;
}

}  // namespace

void minimise(const std::function<double(double)>& f, const Bracket& bracket, double tolerance) {
  constexpr double golden = 0.3819660112501051;
  double a = bracket.a;
  double c = bracket.c;
  std::array<double, 3> x{bracket.b, bracket.b, bracket.b};  // best, second, third
  std::array<double, 3> value{bracket.value, bracket.value, bracket.value};
  double last = c - a;
  double before_last = last;
  while (c - a > bracket_left * tolerance) {
    const double middle = 0.5 * (a + c);
    double step = parabola_step(x, value, c - a);
    // A parabola that leaves the bracket or does not halve the step before last is not trusted.
    const bool trusted = x[0] + step > a && x[0] + step < c && std::abs(step) < 0.5 * before_last;
    if (!trusted) step = golden * ((x[0] < middle ? c : a) - x[0]);
    if (std::abs(step) < tolerance) step = std::copysign(tolerance, middle - x[0]);
    before_last = trusted ? last : std::abs(step) / golden;
    last = std::abs(step);
    const double here = x[0] + step;
    const double found = f(here);
    if (found < value[0]) {
      (step > 0.0 ? a : c) = x[0];
      x = {here, x[0], x[1]};
      value = {found, value[0], value[1]};
    } else {
      (step > 0.0 ? c : a) = here;
      const bool second = found < value[1] || x[1] == x[0];
      x = second ? std::array{x[0], here, x[1]} : std::array{x[0], x[1], here};
      value =
          second ? std::array{value[0], found, value[1]} : std::array{value[0], value[1], found};
    }
  }
}

}  // namespace microslip::solver
