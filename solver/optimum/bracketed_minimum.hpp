/// @file
/// The minimum of a function of one variable inside a bracket.
#pragma once

#include <functional>

namespace microslip::solver {

/// A minimum inside (a, c): f(b) ≤ f(a), f(c).
struct Bracket {
  double a, b, c;
  double value;  ///< at b
};

constexpr double bracket_left = 4.0;  ///< tolerances: what is left of a bracket

/// Golden section with parabolic steps (Brent 1973, chapter 5) until the bracket is below
/// `bracket_left` tolerances; the lowest value met is known to the function.
/// @param tolerance  in the units of the bracket; > 0.
void minimise(const std::function<double(double)>& f, const Bracket& bracket, double tolerance);

}  // namespace microslip::solver
