/// @file
/// What curves, once solved, say of the effects they were simulated with:
/// told in the table of effects.
#pragma once

#include <vector>

#include "pipelines/description/scene_description.hpp"
#include "pipelines/effects/effect_record.hpp"
#include "pipelines/response/run_results.hpp"
#include "pipelines/response/run_summary.hpp"

namespace microslip::pipelines {

/// What harmonics = "auto" has chosen, whether contact was proved linear, and what the search for
/// other solutions found: nothing of these stays undecided.
void tell_curves(const SceneDescription& scene, const std::vector<CurveSummary>& curves,
                 std::vector<EffectRecord>& effects);

/// Whether contact that was not to open, effects.separation = "off", has opened on a curve: an
/// objection then. As long as none does, having it changes nothing: the bound is 0.
void tell_opening(const CurveResult& curve, std::vector<EffectRecord>& effects);

}  // namespace microslip::pipelines
