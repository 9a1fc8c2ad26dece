/// @file
/// Peaks and folds between two accepted points of a branch, solved for on the branch itself:
/// zeros of
///
///   da/ds     from + to −: a peak of the output's amplitude a
///   dω/ds     either way:  a fold
///
/// s the arc length. A cubic through both ends with their slopes tells where to look for a pair of
/// zeros that the ends do not show (a step over a peak and the valley before it). At a kink of the
/// branch the slope jumps through zero; the kink is the peak then. A step that turns unevenly has
/// kinks, and its cubic is not the branch: it is split at them as long as the slope may have zeros
/// in between. What changes its sign is never passed over: where no zero can be solved for, the
/// nearest point is given and said to be no solution.
#pragma once

#include <vector>

#include "solver/branch/branch_walker.hpp"
#include "solver/response_curve.hpp"

namespace microslip::solver {

struct SpecialPoint {
  double share = 0.0;  ///< of the way from before() to now()
  NewtonResult solution;
  PointMark mark = PointMark::none;
  /// False: the slope changes its sign here, Newton's method fails in between;
  /// the nearest point there is.
  bool solved = true;
};

/// The peaks alone, in the order of the branch.
[[nodiscard]] std::vector<SpecialPoint> peaks_between(BranchWalker& walker,
                                                      HarmonicBalance& balance);

/// Peaks and folds, and where a peak and a valley lie between the two points, the valley too,
/// unmarked: a peak is not lower than what comes before and after it. In the order of the branch.
/// Their frequencies carry rounding error only, some 1e-13 relative; at a kink at which Newton's
/// method takes hundreds of evaluations, eight digits of the step.
/// @param until  share of the step that is searched.
[[nodiscard]] std::vector<SpecialPoint> special_points(BranchWalker& walker,
                                                       HarmonicBalance& balance,
                                                       double until = 1.0);

}  // namespace microslip::solver
