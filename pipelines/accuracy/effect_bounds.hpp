/// @file
/// What leaving an effect out does to the peaks, told with the effect.
#pragma once

#include <vector>

#include "pipelines/model/effect_record.hpp"
#include "pipelines/response/error_row.hpp"

namespace microslip::pipelines {

/// Friction along r and harmonics above the first, where they are left out: the largest change of a highest peak,
/// amplitude or frequency, that having them makes. Nothing is added where it has not been told.
void tell_bounds(const std::vector<ErrorRow>& budget, std::vector<EffectRecord>& effects);

}  // namespace microslip::pipelines
