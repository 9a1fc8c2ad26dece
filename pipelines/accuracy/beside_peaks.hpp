/// @file
/// What effects that are left out would change beside the peaks of a curve, which left_out.hpp
/// compares.
#pragma once

#include <vector>

#include "pipelines/accuracy/along_curve.hpp"
#include "pipelines/accuracy/models_left_out.hpp"
#include "pipelines/description/scene_description.hpp"
#include "pipelines/model/reduced_model.hpp"
#include "pipelines/response/error_row.hpp"
#include "pipelines/response/run_results.hpp"

namespace microslip::pipelines {

/// A few points beside the peaks (points_to_check.hpp) are looked at with the effect. Where its
/// indicator is largest, and that of the others which by one step of Newton's method changes most,
/// the curve is solved for again at their frequencies.
/// @param others  models with one effect more each.
/// @param along   their indicators, indicators_along().
/// @param known   the rows of rows_left_out() and of the error budget.
/// @return rows of the goal `amplitude_there`, beyond what the change of the peak makes; none where
///         the peaks are not known, or the other model has no solution near by. Of each model whose
///         peaks are compared one of `along_curve` after them, with all that an amplitude changes
///         by: of up to 14 points, those and others spread over the curve, the two that by one step
///         change most are solved for, and points beside the best of them. None of a curve with
///         more than 300 unknowns, whose sample would take as long as the curve.
[[nodiscard]] std::vector<ErrorRow> rows_there(const ReducedModel& model,
                                               const SceneDescription& scene,
                                               const std::vector<RicherModel>& others,
                                               const CurveResult& result,
                                               const std::vector<IndicatorOfCurve>& along,
                                               const std::vector<ErrorRow>& known);

}  // namespace microslip::pipelines
