/// @file
/// The model with an effect that is left out, beside that without.
#pragma once

#include <optional>

#include "pipelines/description/scene_description.hpp"
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

/// What may be solved again of an effect and a curve [s].
inline constexpr double bearable = 60.0;

/// Of a whole curve with the effect: as long as a curve may take, and no longer than is
/// bearable [s].
[[nodiscard]] double seconds_of_trace(const SceneDescription& scene);

/// The whole curve with the effect: a peak of one that leans over, or jumps, may lie where nothing
/// leads to from that without. @param own  the curve without. @param seconds  it may take, at most.
/// @return empty: it has no peak, or takes too long.
[[nodiscard]] std::optional<solver::ResponseCurve> traced_with(const solver::OtherModel& with,
                                                               solver::ContinuationOptions options,
                                                               const solver::ResponseCurve& own,
                                                               double seconds);

/// The highest peak of the whole curve with the effect, where a mode resonates with it alone and
/// above an amplitude [m] in the linear limit: no peak of the curve without leads there.
/// @return empty: there is no such mode, the peak is no higher, or traced_with() has none.
[[nodiscard]] std::optional<solver::ResponsePoint> peak_only_with(
    const solver::Scene& own, const solver::OtherModel& with,
    const solver::ContinuationOptions& options, const solver::ResponseCurve& curve,
    double amplitude, double seconds);

/// The static preload with an effect may be another one. @param load  of the curve without.
[[nodiscard]] double load_with(const ReducedModel& richer, const ReducedModel& model, double load);

}  // namespace microslip::pipelines
