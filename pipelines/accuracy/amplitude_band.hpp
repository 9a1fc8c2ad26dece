/// @file
/// Between which amplitudes a curve lies at each of its frequencies, by the errors of its budget.
#pragma once

#include "pipelines/accuracy/error_budget.hpp"
#include "pipelines/response/run_results.hpp"

namespace microslip::pipelines {

/// A point of the right curve lies within a box about that of this one: A (1 ± a), ω (1 ± w). Of
/// the highest peak a and w are its bars; of all other points their harmonics count as they do
/// there (CurveBudget::along), all other sources as at the peak. The band at a row is that of the
/// boxes of the branch about it that hold its frequency: where the curve is steep it is as wide as
/// the error of its frequency makes it, and across a fold it has both sides.
/// @param budget  of the curve, with a bar.
[[nodiscard]] AmplitudeBand amplitude_band(const CurveResult& result, const CurveBudget& budget);

}  // namespace microslip::pipelines
