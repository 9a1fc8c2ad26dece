/// @file
/// Random states of a contact point, by stratum: every regime and every degenerate limit.
#pragma once

#include <random>
#include <string_view>
#include <vector>

#include "contact/closed_form/friction_cycle.hpp"

namespace microslip::test {

struct CycleCase {
  contact::PointParameters point;
  contact::PointMotion motion;
};

/// k_u a + μ (|n₀| + B): what friction coefficients are compared with.
[[nodiscard]] double friction_scale(const CycleCase& c);
/// |n₀| + B.
[[nodiscard]] double normal_scale(const CycleCase& c);

using Random = std::mt19937_64;
struct Stratum {
  std::string_view name;
  CycleCase (*draw)(Random&);
};

/// Generic states, magnitudes over several decades.
[[nodiscard]] CycleCase generic_case(Random& random);
/// All strata, the generic ones first.
[[nodiscard]] const std::vector<Stratum>& strata();

}  // namespace microslip::test
