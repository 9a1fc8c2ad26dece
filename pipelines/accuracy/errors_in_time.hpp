/// @file
/// How far a motion integrated in time can be trusted: what its steps, and the frequencies it was
/// integrated at, do to the largest one.
#pragma once

#include <optional>

#include "pipelines/description/scene_description.hpp"
#include "pipelines/model/reduced_model.hpp"
#include "pipelines/response/run_results.hpp"

namespace microslip::pipelines {

/// The largest motion integrated on with steps that end where the contact changes: it differs by
/// what steps of the scene do, or, where they end so already, by what the approach to the steady
/// state has left.
/// @param result  integrated, with a largest motion.
/// @return empty: it did not come to a steady state again, or time was over.
[[nodiscard]] std::optional<solver::ResponsePoint> integrated_with_events(
    const ReducedModel& model, const SceneDescription& scene, const CurveResult& result,
    double load);

/// Relative changes from the largest motion to the top between frequencies.
struct TopBetween {
  double frequency = 0.0;
  double amplitude = 0.0;
};

/// The top of a parabola through the largest motion and those at the frequencies beside it.
/// @return empty: the largest one lies at an end, or beside a jump, where nothing tells how far its
///         branch goes on.
[[nodiscard]] std::optional<TopBetween> top_between(const solver::ResponseCurve& curve);

}  // namespace microslip::pipelines
