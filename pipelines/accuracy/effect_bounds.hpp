/// @file
/// What leaving an effect out does to the peaks, told with the effect.
#pragma once

#include <string>
#include <vector>

#include "pipelines/effects/beside_bar.hpp"
#include "pipelines/effects/effect_record.hpp"
#include "pipelines/response/error_row.hpp"

namespace microslip::pipelines {

/// EffectRecord::bound of effects that are left out: the largest change of a highest peak,
/// amplitude or frequency, that having them makes. Beyond the tolerance that is an objection;
/// within it, it answers the one of the indicator. Curves without a peak within their range are
/// told in words, with the change of the resonance. What several effects change together is
/// EffectRecord::bound_together of each. Where no row tells anything, it is said that there is no
/// bound, and why.
/// @param rows  of error budgets, and of rows_left_out().
/// @param none  of effects that are owed a bound.
void tell_bounds(const std::vector<ErrorRow>& rows, double tolerance,
                 std::vector<EffectRecord>& effects, const std::vector<NoBound>& none = {});

/// The same of one curve, beside its bar: every effect that is left out, each alone.
/// @param rows   of rows_left_out().
/// @param names  of effects that are left out (effects_left_out()).
[[nodiscard]] BesideBar beside_bar(const std::vector<ErrorRow>& rows,
                                   const std::vector<std::string>& names);

/// An effect that `auto` had left out, and that matters.
struct MissedEffect {
  std::string name;
  double change = 0.0;  ///< relative, of a highest peak by leaving it out; infinite: as in a row
};

/// Those that a run can put back, normal motion, friction along r, roughness and friction by speed:
/// left to `auto`, left out, and having them changes a highest peak by more than the tolerance.
/// What a user switches off stays off.
/// @param rows  as of tell_bounds().
[[nodiscard]] std::vector<MissedEffect> missed_effects(const std::vector<ErrorRow>& rows,
                                                       double tolerance,
                                                       const std::vector<EffectRecord>& effects);

/// Tells of effects that a run has put back that this was so: simulated,
/// the setting the user's `auto`.
/// @param effects  of the scene with them on.
void tell_switched_on(const std::vector<MissedEffect>& missed, std::vector<EffectRecord>& effects);

}  // namespace microslip::pipelines
