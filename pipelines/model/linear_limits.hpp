/// @file
/// The two linear limits of a reduced model, every contact point free and every one stuck: what is
/// told of a scene before anything nonlinear is solved (theory section 13.2).
#pragma once

#include <vector>

#include <Eigen/Core>

#include "pipelines/model/reduced_model.hpp"

namespace microslip::pipelines {

/// Σ w (φ_u k_u φ_uᵀ + φ_v k_v φ_vᵀ + φ_w k_w φ_wᵀ) of the contact points [1/s²], N × N. Points
/// without friction have normal stiffness alone.
/// @param along_r  with that along r.
[[nodiscard]] Eigen::MatrixXd stuck_stiffness(const ReducedModel& model, bool along_r = true);

/// Response of the modes with a stiffness added, q_s + i q_c [m√kg];
/// not finite at a resonance without damping.
[[nodiscard]] Eigen::VectorXcd linear_response(const ReducedModel& model,
                                               const Eigen::MatrixXd& stiffness, double frequency);

/// Of the modes with a stiffness added [rad/s], ascending, N.
[[nodiscard]] Eigen::VectorXd resonances(const ReducedModel& model,
                                         const Eigen::MatrixXd& stiffness);

}  // namespace microslip::pipelines
