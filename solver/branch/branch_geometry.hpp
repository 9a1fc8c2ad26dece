/// @file
/// Points, directions and curves in the space of the unknowns and the parameter, in scaled
/// variables: what a step along a branch is measured with.
#pragma once

#include <vector>

#include "solver/balance/newton.hpp"

namespace microslip::solver {

/// A point of the branch with what the next step and the search for peaks and folds need.
struct WalkerPoint {
  NewtonResult solution;
  BranchVector tangent;  ///< in scaled variables of `scaling`
  Scaling scaling;
};

[[nodiscard]] double dot(const BranchVector& a, const BranchVector& b);
[[nodiscard]] double length(const BranchVector& a);
/// A direction of length one from the scaled variables of one scaling to those of another.
[[nodiscard]] BranchVector rescaled(const BranchVector& direction, const Scaling& from,
                                    const Scaling& to);
/// Of the branch at a solution, at less than 90° to `previous`: by the factors that came with it,
/// else by its derivatives.
/// @param previous  in variables of `scaling`, as the result.
[[nodiscard]] Tangent tangent_at(const NewtonResult& at, const BranchVector& previous,
                                 const Scaling& scaling);
/// a − b in scaled variables.
[[nodiscard]] BranchVector difference(const BranchVector& a, const BranchVector& b,
                                      const Scaling& scaling);
/// @param direction  in scaled variables.
[[nodiscard]] BranchVector moved(const BranchVector& from, const BranchVector& direction,
                                 double distance, const Scaling& scaling);

/// A point of a step with the derivative of the branch by the share of the way along the chord.
struct Knot {
  /// @param chord  of the step, of length one.   @param size  its length before that.
  Knot(const WalkerPoint& at, const BranchVector& chord, double size, const Scaling& scaling);

  BranchVector point;
  BranchVector derivative;
};

/// Hermite's cubic through two knots at a share u of the way between them.
/// @param width  share of the step that lies between them.
[[nodiscard]] BranchVector cubic_between(const Knot& a, const Knot& b, double u, double width);

/// Guesses for the branch at a share u of the way between two knots, all of them in one plane
/// across the chord. Where the branch is an arc about a region of another regime,
/// the tangents lie outside of it.
[[nodiscard]] std::vector<BranchVector> starts_between(const Knot& a, const Knot& b, double u,
                                                       double width);

}  // namespace microslip::solver
