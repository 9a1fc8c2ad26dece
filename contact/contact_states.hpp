/// @file
/// States of all points of a patch under one motion, and how much of them is different under
/// another: what a step control wants to know of a step.
#pragma once

#include <vector>

#include "contact/point/period_states.hpp"

namespace microslip::contact {

struct PointStates {
  double share = 0.0;  ///< of the area of the patch, all of them sum to 1
  CycleStates cycle;
};

/// Of the points that have area, always in the same order. Empty: not told.
using ContactStates = std::vector<PointStates>;

struct StateChange {
  double share = 0.0;    ///< of (area × period) in another state
  double largest = 0.0;  ///< share of the period in another state, of the point that changes most
  int n_regimes = 0;     ///< points with another kind of cycle
};

/// @return zeros where the points are not the same.
[[nodiscard]] StateChange state_change(const ContactStates& before, const ContactStates& after);

}  // namespace microslip::contact
