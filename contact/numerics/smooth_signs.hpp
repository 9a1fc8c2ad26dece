/// @file
/// All sign changes of two smooth functions of one number on an interval.
///
///   f(x) = Σ_k c_k T_k(x) on a cell [−1, 1],     |f − c₀| ≤ Σ_{k>0} |c_k|                      (1)
///
/// Cells are halved until the last coefficients are below a tolerance, or so far below the others
/// that what follows is beyond doubt; then (1) for f proves that its sign
/// is kept, (1) for f' that there is one change at most, or the polynomial is halved. Pairs of
/// changes are told from none as long as f rises between them to the tolerance.
///
/// Points of a cell lie inside, so that a kink at an end does not matter.
#pragma once

#include <array>
#include <functional>
#include <vector>

namespace microslip::contact {

struct SmoothSign {
  double phase = 0.0;
  int function = 0;  ///< 0 or 1
};

/// Two functions at once, as they come from one evaluation.
using SmoothPair = std::function<std::array<double, 2>(double phase)>;

inline constexpr int n_smooth_nodes = 12;
using SmoothValues = std::array<double, n_smooth_nodes>;

/// The same at all nodes of a cell, middle + half · share.
using SmoothCell = std::function<void(double middle, double half, const SmoothValues& shares,
                                      std::array<SmoothValues, 2>& values)>;

/// Both give the same.
struct SmoothFunctions {
  SmoothPair at;
  SmoothCell over_cell;
};

/// @param functions  smooth inside (begin, end).
/// @param cell       longest cell, as long as the functions are expected to be resolved on.
/// @param size       of the functions: tolerance is 1e-10, rounding 1e-15 of it; where they are
///                   larger than that, 1e-11 of what they are.
/// @param found      sign changes are added, function by function and cell by cell; not sorted.
void add_smooth_signs(const SmoothFunctions& functions, double begin, double end, double cell,
                      double size, std::vector<SmoothSign>& found);
/// The same node by node.
void add_smooth_signs(const SmoothPair& functions, double begin, double end, double cell,
                      double size, std::vector<SmoothSign>& found);

}  // namespace microslip::contact
