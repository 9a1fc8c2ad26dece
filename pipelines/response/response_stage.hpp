/// @file
/// Reduced model → one response curve: balanced, in time, or a linear limit.
#pragma once

#include "pipelines/description/curve_request.hpp"
#include "pipelines/model/reduced_model.hpp"
#include "pipelines/response/run_results.hpp"
#include "pipelines/response/time_response.hpp"
#include "solver/continuation.hpp"

namespace microslip::pipelines {

/// The curve of a linear limit over the range of a scene.
[[nodiscard]] solver::ResponseCurve limit_curve(const ReducedModel& model,
                                                const SceneDescription& scene, LimitName limit);

/// Traces one curve: a solution at one frequency when the range has no width.
/// @param near  the curve of a poorer model with the same modes,
///              beside whose beginning this one begins; nullptr: none.
[[nodiscard]] CurveResult trace_curve(const ReducedModel& model, const SceneDescription& scene,
                                      const CurveRequest& request,
                                      const solver::PointObserver& observe,
                                      const solver::ResponseCurve* near = nullptr);

/// As trace_curve() of a curve that is traced already: its harmonics are checked with more.
/// @param request  of a load, no limit.
/// @param curve    of the model under that load, with the harmonics of the scene.
[[nodiscard]] CurveResult checked_curve(const ReducedModel& model, const SceneDescription& scene,
                                        const CurveRequest& request, solver::ResponseCurve curve);

/// Another model integrated in time over the range of a scene, begun with the motion of a point of
/// the curve.
/// @param point      at the first frequency of the range.
/// @param embedding  modal coordinates from those of the curve; empty: the same modes.
[[nodiscard]] solver::ResponseCurve integrated_elsewhere(const ReducedModel& model,
                                                         const SceneDescription& scene, double load,
                                                         const solver::ResponsePoint& point,
                                                         const Eigen::MatrixXd& embedding,
                                                         Closeness closely = Closeness::result);

}  // namespace microslip::pipelines
