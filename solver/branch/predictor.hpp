/// @file
/// Where the next point of a branch is expected: along the tangent, on the parabola that turns as
/// the last two tangents do, or on the cubic through the last two points with their tangents,
/// whichever foretold the last point best. At a kink that is the tangent.
///
///   y(s) = y₀ + s t₀ + s² a + s³ b,    y(−L) = y₋, y′(−L) = t₋:   b = (2D − E)/L, a = 3D − E,
///   D = (y₋ − y₀ + L t₀)/L²,  E = (t₀ − t₋)/L;                     parabola: a = E/2, b = 0
#pragma once

#include "solver/branch/branch_geometry.hpp"

namespace microslip::solver {

class BranchPredictor {
 public:
  /// @param before, now  the last two points; the same point twice:
  ///                     nothing but the tangent is known.
  /// @param ahead        from `now`, in its scaling.
  [[nodiscard]] BranchVector point(const WalkerPoint& before, const WalkerPoint& now,
                                   double ahead) const;
  /// @param next  what was found from `now`.
  void learn(const WalkerPoint& before, const WalkerPoint& now, const BranchVector& next);

 private:
  int order_ = 1;
};

}  // namespace microslip::solver
