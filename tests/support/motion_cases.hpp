/// @file
/// Random states of a contact point under motion of many harmonics, by stratum: every regime and
/// the degenerate limits.
#pragma once

#include <random>
#include <string_view>
#include <vector>

#include "contact/harmonics.hpp"
#include "contact/patch/contact_patch.hpp"

namespace microslip::test {

struct MotionCase {
  contact::PointParameters point;
  contact::Harmonics motion;  ///< u, v, w; w is noise, laws of one direction must not see it
};

/// k_u |u| + μ (|n₀| + k_v |v|), |·| the sum of the amplitudes of the harmonics.
[[nodiscard]] double friction_scale(const MotionCase& c);
/// |n₀| + k_v |v|.
[[nodiscard]] double normal_scale(const MotionCase& c);
/// n₀' + k_v v at its smallest, by dense sampling and refinement.
[[nodiscard]] double smallest_load(const MotionCase& c);

/// ∮ f dy of one signal over a period, Σ h π (y_s f_c − y_c f_s).
[[nodiscard]] double cycle_work(const contact::Harmonics& motion, const contact::Harmonics& force,
                                Eigen::Index signal);

struct MotionStratum {
  std::string_view name;
  MotionCase (*draw)(std::mt19937_64&);
};

/// H from 1 to 6, magnitudes over several decades.
[[nodiscard]] MotionCase generic_motion(std::mt19937_64& random);
/// All strata, the generic one first.
[[nodiscard]] const std::vector<MotionStratum>& motion_strata();

}  // namespace microslip::test
