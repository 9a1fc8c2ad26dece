/// @file
/// Damping of the modes as a scene gives it.
#pragma once

#include <Eigen/Core>

#include "pipelines/description/scene_description.hpp"

namespace microslip::pipelines {

/// Damping ratio of each mode. Attachment shapes take the last ratio of a list.
/// @param frequency  ω_n [rad/s].
/// @param n_attachment  so many of them, the last, are attachment shapes.
/// @throws SceneError  a list of another length than the modes, or α ≠ 0 with a rigid-body mode.
[[nodiscard]] Eigen::VectorXd damping_ratios(const ModesDescription& modes,
                                             const Eigen::VectorXd& frequency,
                                             Eigen::Index n_attachment = 0);

}  // namespace microslip::pipelines
