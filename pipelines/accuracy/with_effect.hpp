/// @file
/// The model with an effect that is left out, beside that without.
#pragma once

#include <optional>

#include "pipelines/model/reduced_model.hpp"
#include "solver/continuation_options.hpp"
#include "solver/response_curve.hpp"
#include "solver/richer_peak.hpp"
#include "solver/scene.hpp"

namespace microslip::pipelines {

/// The amplitude of another model at the frequency of a point. @return empty: none is near by.
[[nodiscard]] std::optional<solver::PeakOfBoth> at_its_frequency(
    const solver::Scene& own, solver::ContinuationOptions options,
    const solver::ResponsePoint& point, const solver::OtherModel& with);

/// The static preload with an effect may be another one. @param load  of the curve without.
[[nodiscard]] double load_with(const ReducedModel& richer, const ReducedModel& model, double load);

}  // namespace microslip::pipelines
