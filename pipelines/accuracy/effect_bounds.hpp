/// @file
/// What leaving an effect out does to the peaks, told with the effect.
#pragma once

#include <vector>

#include "pipelines/model/effect_record.hpp"
#include "pipelines/response/error_row.hpp"

namespace microslip::pipelines {

/// EffectRecord::bound of effects that are left out: the largest change of a highest peak, amplitude or frequency, that
/// having them makes. Beyond the tolerance that is an objection; within it, it answers the one of the indicator. Nothing
/// is told where no row does.
/// @param rows  of error budgets, and of rows_left_out().
void tell_bounds(const std::vector<ErrorRow>& rows, double tolerance,
                 std::vector<EffectRecord>& effects);

}  // namespace microslip::pipelines
