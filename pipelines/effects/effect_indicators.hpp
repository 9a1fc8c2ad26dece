/// @file
/// Dimensionless numbers that say, before anything nonlinear is solved, which effects of contact a
/// scene calls for: from the motion of the patch in both linear limits, in the frequency range and
/// at the resonances near by. What they are compared with stands in effect_table.hpp.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "pipelines/description/scene_description.hpp"
#include "pipelines/model/reduced_model.hpp"

namespace microslip::pipelines {

/// How far the linear limits drive the points under a load. Infinite where a limit has no bound, or
/// a point carries nothing and moves. With effects.normal_motion = "off" `slip` and `nearby` are of
/// constant loads, the others of what that leaves out.
struct ContactReach {
  /// Force of a point in the stuck limit over what friction holds there at the least load of the
  /// period; where the point is open, approach in the free limit over its gap. Below 1 everywhere:
  /// contact is linear.
  double slip = 0.0;
  /// Change of the load k_v|v| over the load, or over that which would close the gap.
  double load = 0.0;
  double bias_load = 0.0;  ///< the same of the mean: static forces, and what opening adds to it
  /// As `load`: of loaded points at resonances of the stuck, of open ones at those of the free
  /// structure, whose way from one limit to the other leads through the range. Where friction falls
  /// with speed, the force of the stuck limit there over what it holds at the highest speed too.
  double nearby = 0.0;
  /// Of that, by resonances outside the range: a curve does not pass them, and a branch of theirs
  /// that leads into the range is not met.
  double outside = 0.0;
};

/// Of all curves under a load, and of what is searched: the ends of a range of preloads, else the
/// one load, by the measure of the model.
/// @throws RefusedError  a gap, or a load below 0, where the normal stiffness is zero.
[[nodiscard]] std::vector<double> loads_of(const ReducedModel& model,
                                           const SceneDescription& scene);

/// Under one load of a curve, by the measure of the model.
[[nodiscard]] ContactReach contact_reach(const ReducedModel& model, const SceneDescription& scene,
                                         double load);

/// The largest over all loads the scene asks for; loads that its contact cannot carry are left out:
/// they are refused where they are solved for. Without value: no [response], or no load.
[[nodiscard]] std::optional<ContactReach> contact_reach(const ReducedModel& model,
                                                        const SceneDescription& scene);

/// Of the curves under a load, those whose points stay below 1 by `slip`: the run will prove them
/// linear, unless effects.nonlinearity is "on".
[[nodiscard]] int n_linear_curves(const ReducedModel& model, const SceneDescription& scene);

/// Of the strain energy of the stuck limit, in the springs along the normal:
/// the largest in the range.
[[nodiscard]] double normal_energy_share(const ReducedModel& model, const SceneDescription& scene);

/// Where a multiple of the frequency answers most.
struct HarmonicAnswer {
  double ratio = 0.0;  ///< answer of the patch to a force at kω over that at ω, over k²
  int order = 0;
  double frequency = 0.0;  ///< kω [rad/s]
};

/// Over k = 2 … 30 and the resonances ω of both limits in the range; without one,
/// of the free limit at its ends.
[[nodiscard]] HarmonicAnswer harmonic_answer(const ReducedModel& model,
                                             const SceneDescription& scene);

/// Moment of the load that turning changes on each patch, over half its size, about p or r
/// through the middle [N]: the largest in the range, of the stuck limit. Infinite where that has no
/// bound.
[[nodiscard]] std::vector<double> turning_forces(const ReducedModel& model,
                                                 const SceneDescription& scene);

/// Of one patch in one motion, its first harmonic.
[[nodiscard]] double turning_force(const contact::Patch& patch, const Eigen::VectorXcd& motion);

/// Root mean square over a face of the variation of its motion along p and r, over its mean, over
/// √3: 1/3 of one that is zero at one edge and varies linearly. Of each linear limit where in the
/// range it moves the face most, the largest of both and of all patches.
[[nodiscard]] double uneven_motion(const ReducedModel& model, const SceneDescription& scene);

/// |μ(σ) − μ(0)|/μ(0) at the highest speed σ of the linear limits, in the range and at resonances
/// that contact bends into it, the largest of all patches; of the law that the scene gives,
/// simulated or not.
[[nodiscard]] double friction_change(const ReducedModel& model, const SceneDescription& scene);

/// Attachment shapes: relative change of the stuck frequency nearest to the range without them.
/// Else the largest share of residual flexibility in the tangential flexibility of a point.
[[nodiscard]] double residual_share(const ReducedModel& model, const SceneDescription& scene);

}  // namespace microslip::pipelines
