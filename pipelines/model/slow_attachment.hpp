/// @file
/// Attachment shapes for integration in time. Their ω̃ lie far above everything that moves, where
/// they answer statically, but explicit steps would have to follow them.
/// Mass is added to those above a limit ω_l:
///
///   a' = a / s,   φ' = s φ,   Q' = s Q,   ω' = s ω̃ = ω_l,      s = ω_l / ω̃ < 1
///
/// The static answer φφᵀ/ω̃² is the same to the last digit; at ω the amplification 1/(1 − ω²/ω̃²)
/// of the shapes becomes 1/(1 − ω²/ω_l²): off by (ω/ω_l)² of what the shapes contribute.
/// (Known as selective mass scaling; in modal coordinates it is a factor.)
#pragma once

#include <Eigen/Core>

#include "contact/harmonics.hpp"
#include "pipelines/model/reduced_model.hpp"

namespace microslip::pipelines {

/// s of each mode [-]: 1 for free modes and shapes below ω_l = max(2 ω of the highest free mode,
/// 20 ω).
/// @param frequency  highest ω of the excitation [rad/s].
[[nodiscard]] Eigen::VectorXd slowing(const ReducedModel& model, double frequency);

/// The model in the coordinates a'. @param factors  s, one per mode.
[[nodiscard]] ReducedModel slowed(ReducedModel model, const Eigen::VectorXd& factors);

}  // namespace microslip::pipelines
