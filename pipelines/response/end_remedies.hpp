/// @file
/// What to set where a curve, or a search for a best value, has not come to its end: one sentence
/// for every way to end, with keys of the scene or options of the command line.
#pragma once

#include <string_view>

#include "pipelines/description/scene_description.hpp"
#include "solver/diagnosis.hpp"
#include "solver/optimum.hpp"
#include "solver/response_curve.hpp"

namespace microslip::pipelines {

/// @return empty: `Diagnosis::none`, and nothing else.
[[nodiscard]] std::string_view remedy_of(solver::Diagnosis diagnosis,
                                         ResponseDescription::Method method);
/// The same where response.time_budget is over.
[[nodiscard]] std::string_view remedy_of_time();
/// @return empty: `NotFound::none`, and nothing else.
[[nodiscard]] std::string_view remedy_of(solver::NotFound reason);

/// Ends the message of an incomplete curve with its remedy.
void tell_remedy(std::string_view remedy, solver::ResponseCurve& curve);
/// The same of what is said of a search without a result.
void tell_remedy(std::string_view remedy, solver::Optimum& optimum);

}  // namespace microslip::pipelines
