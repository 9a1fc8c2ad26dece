/// @file
/// Effects that are left out, looked at along whole curves: the indicator of the table of effects
/// again, of the nonlinear motion at every solution point. What having them changes is told by the
/// peaks (left_out.hpp, error_budget.hpp), and by a few points beside them (points_to_check.hpp).
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "pipelines/accuracy/richer_models.hpp"
#include "pipelines/model/reduced_model.hpp"
#include "pipelines/response/error_row.hpp"
#include "pipelines/response/run_results.hpp"

namespace microslip::pipelines {

/// An indicator at every solution point of a curve.
struct IndicatorOfCurve {
  std::string effect;
  Eigen::VectorXd at;  ///< n_points [-]
};

/// Of a curve, for each effect that is left out and whose indicator depends on the motion:
///
/// - normal_motion, separation: change k_v (|mean| + Σ_k amplitude) of the load over the load;
/// - mean_coupling: the same of the mean alone;
/// - second_direction: motion along r over that along p, rms over area and period;
/// - higher_harmonics, of curves that have the first alone: motion that the contact force drives at
///   a multiple of the frequency, of the free structure, over the motion of the first harmonic;
/// - rate_dependence: change of the coefficient at the speed Σ_k kω amplitude;
/// - roughness: its height over the least compression of the period, of all points together;
/// - moments: moment of the load that turning changes over load times half the size.
///
/// Others have indicators that do not depend on the motion.
/// @param model   a curve was solved with.
/// @param scene   of the model: what is "off" in it, and what it gives.
/// @param others  the model with one effect more each.
/// @return none of linear limits, and of motions that are integrated.
[[nodiscard]] std::vector<IndicatorOfCurve> indicators_along(const ReducedModel& model,
                                                             const SceneDescription& scene,
                                                             const std::vector<RicherModel>& others,
                                                             const CurveResult& result);

/// The largest of all solution points, and where: a row of the goal `largest_indicator`.
[[nodiscard]] ErrorRow largest_along(const IndicatorOfCurve& indicator, const CurveResult& result);

}  // namespace microslip::pipelines
