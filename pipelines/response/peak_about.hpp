/// @file
/// The highest peak of a model from its curve about a frequency: where Newton's method does not
/// lead to it from the peak of another model.
#pragma once

#include <optional>

#include "pipelines/model/reduced_model.hpp"
#include "solver/continuation_options.hpp"
#include "solver/response_curve.hpp"
#include "solver/scene.hpp"

namespace microslip::pipelines {

/// A curve for its highest place alone: nothing is searched beside it, stability is not judged.
/// @param options  of the whole curve, harmonics given; `stop` ends it.
[[nodiscard]] solver::ResponseCurve curve_for_its_peak(const solver::Scene& scene,
                                                       solver::ContinuationOptions options);

/// @param load       as of point_parameters.hpp.
/// @param options    of the whole curve, harmonics given; stability is not judged.
/// @param frequency  [rad/s]: the curve is traced some resonance widths of a lightly damped blade
///                   to either side, within its range.
/// @return  empty: it is stopped, or has no peak there that is above all else.
[[nodiscard]] std::optional<solver::ResponsePoint> peak_about(const ReducedModel& model,
                                                              double load,
                                                              solver::ContinuationOptions options,
                                                              double frequency);

}  // namespace microslip::pipelines
