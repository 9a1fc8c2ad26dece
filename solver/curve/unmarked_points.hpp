/// @file
/// What a finished curve shows and nobody solved for: a row larger than both its neighbours with no
/// peak marked close by, a row at which the frequency turns with no fold. Between two steps the
/// force or the harmonics may be replaced; a slope that changes its sign by that lies in no step.
#pragma once

#include "solver/response_curve.hpp"

namespace microslip::solver {

/// Marks such rows and says so in the log: peak-unsolved, fold-unsolved. Curves that are not
/// complete, or that were entered anew on the way, are left alone:
/// their rows need not be neighbours.
void mark_unsolved(ResponseCurve& curve);

}  // namespace microslip::solver
