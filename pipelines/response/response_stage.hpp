/// @file
/// Reduced model → solver scenes → curves, maps and the best preload.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "pipelines/description/curve_request.hpp"
#include "pipelines/model/reduced_model.hpp"
#include "pipelines/response/run_results.hpp"
#include "solver/continuation.hpp"
#include "solver/scene.hpp"

namespace microslip::pipelines {

/// A model under a load (point_parameters.hpp) as the solver takes it.
/// Modes and excitation of the model are copied.
[[nodiscard]] solver::Scene solver_scene(const ReducedModel& model, double load);

/// With the contact in time where that judges stability (solver/stability/stability.hpp).
[[nodiscard]] solver::Scene balanced_scene(const ReducedModel& model, double load,
                                           const solver::ContinuationOptions& options);

/// For the free and the stuck limit, which know no preload: no moment tilts, rough surfaces are in
/// full contact.
[[nodiscard]] solver::Scene limit_scene(ReducedModel model);

/// The curve of one of them over the range of a scene.
[[nodiscard]] solver::ResponseCurve limit_curve(const ReducedModel& model,
                                                const SceneDescription& scene, LimitName limit);

/// Natural frequencies with every contact point stuck [Hz], ascending, as many as the model has.
[[nodiscard]] Eigen::VectorXd stuck_frequencies(const ReducedModel& model);

/// Moments beside the preload can be balanced under all loads the scene asks for.
/// @throws RefusedError  they cannot; the message names the force they need.
void require_loads(const ReducedModel& model, const SceneDescription& scene);

/// What can be told of the curves before the first is traced: moments beside every preload are
/// balanced, fixed steps in time are enough.
/// @throws RefusedError, SceneError  as require_loads() and require_steps().
void require_curves(const ReducedModel& model, const SceneDescription& scene);

/// @param model  whose contact says how exactly its forces can be balanced.
[[nodiscard]] solver::ContinuationOptions continuation_options(const SceneDescription& scene,
                                                               const ReducedModel& model);

/// The highest harmonic that results of a scene with given harmonics are checked with; 0: they are
/// chosen, there is no contact, or the check would be dear.
[[nodiscard]] int harmonics_to_check(const ReducedModel& model, const SceneDescription& scene);

/// @throws SceneError    no [response], or one that speaks of a contact the scene does not have.
/// @throws RefusedError  a preload of the list that cannot carry the moments of the scene.
void require_response(const SceneDescription& scene);

/// @throws RefusedError  a rigid-body mode is held neither by supports nor by the contact.
void require_held(const ReducedModel& model, const SceneDescription& scene);

/// Traces one curve: a solution at one frequency when the range has no width.
/// @param near  the curve of a poorer model with the same modes,
///              beside whose beginning this one begins; nullptr: none.
[[nodiscard]] CurveResult trace_curve(const ReducedModel& model, const SceneDescription& scene,
                                      const CurveRequest& request,
                                      const solver::PointObserver& observe,
                                      const solver::ResponseCurve* near = nullptr);

/// Another model integrated in time over the range of a scene, begun with the motion of a point of
/// the curve.
/// @param point      at the first frequency of the range.
/// @param embedding  modal coordinates from those of the curve; empty: the same modes.
[[nodiscard]] solver::ResponseCurve integrated_elsewhere(const ReducedModel& model,
                                                         const SceneDescription& scene, double load,
                                                         const solver::ResponsePoint& point,
                                                         const Eigen::MatrixXd& embedding);

/// Solves the highest peak with more harmonics than were given,
/// where the contact is not proved linear: result.richer. When it is stopped the message of the
/// curve says so instead.
/// @param stop  asked between its steps.
void check_harmonics(
    ReducedModel model, const SceneDescription& scene, double load, CurveResult& result,
    const std::function<bool()>& stop = [] { return false; });

/// Of accuracy.budget, what one curve may take to be checked with more harmonics: other curves want
/// to begin before it ends.
inline constexpr double share_of_check = 0.1;

struct CurveMaps {
  std::vector<NamedMap> maps;
  std::vector<std::string> missing;  ///< which map there is not, why, and what to set
};

/// Contact maps the scene asks for on this curve: at its highest peak, its folds, or all solutions
/// of the branch at given frequencies (numbered in branch order).
[[nodiscard]] CurveMaps curve_maps(const ReducedModel& model, const SceneDescription& scene,
                                   const CurveResult& result);

/// The highest solved peak; without one the largest point. nullptr: no points.
[[nodiscard]] const solver::ResponsePoint* highest_peak(const solver::ResponseCurve& curve);

}  // namespace microslip::pipelines
