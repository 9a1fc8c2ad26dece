/// @file
/// Damping of the modes as a scene gives it.
#pragma once

#include <Eigen/Core>

#include "pipelines/scene/scene_description.hpp"

namespace microslip::pipelines {

/// Damping ratio of each mode. @param frequency  ω_n [rad/s].
/// @throws SceneError  a list of another length than the modes, or α ≠ 0 with a rigid-body mode.
[[nodiscard]] Eigen::VectorXd damping_ratios(const ModesDescription& modes,
                                             const Eigen::VectorXd& frequency);

}  // namespace microslip::pipelines
