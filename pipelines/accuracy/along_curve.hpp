/// @file
/// Effects that are left out, looked at along whole curves: the indicator of the table of effects
/// again, of the nonlinear motion at every solution point. What having them changes is told by the
/// peaks (left_out.hpp, error_budget.hpp).
#pragma once

#include <vector>

#include "pipelines/accuracy/richer_models.hpp"
#include "pipelines/model/reduced_model.hpp"
#include "pipelines/response/error_row.hpp"
#include "pipelines/response/run_results.hpp"

namespace microslip::pipelines {

/// Of normal motion: the largest change of a point's load over its load; of friction along r:
/// motion along r over that along p, rms over area and period.
/// @param model   a curve was solved with.
/// @param others  the model with one effect more each; other sources than these two tell nothing.
/// @return a row of the goal `largest_indicator` for each.
[[nodiscard]] std::vector<ErrorRow> rows_along_curve(const ReducedModel& model,
                                                     const std::vector<RicherModel>& others,
                                                     const CurveResult& result);

}  // namespace microslip::pipelines
