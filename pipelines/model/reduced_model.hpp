/// @file
/// What the response stage solves: modes, excitation, output and the patches of contact,
/// as plain arrays.
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "contact/contact_effects.hpp"
#include "contact/motion_coordinates.hpp"
#include "contact/patch.hpp"

namespace microslip::pipelines {

using contact::ContactEffects;

/// What the response stage needs, and model.h5 holds: the same for scenes with a mesh and without.
struct ReducedModel {
  Eigen::VectorXd frequency;  ///< ω_n [rad/s], N
  Eigen::Index n_attachment =
      0;  ///< so many of the N, the last, are attachment shapes (theory 14.1)
  Eigen::VectorXd damping_ratio;                           ///< N
  Eigen::VectorXd force_sine, force_cosine, force_static;  ///< modal force [N/√kg], N
  Eigen::VectorXd output;                                  ///< y = output · q [1/√kg], N
  std::vector<contact::Patch> patches;                     ///< none: no contact
  std::optional<double>
      static_preload;  ///< what they carry under the static loads of the scene [N]
  std::optional<double> static_variation;  ///< of the pressure then, over its mean [-]
  ContactEffects effects;
  contact::MotionCoordinates coordinates;  ///< of the patches, where forces are sampled in time
};

/// Whether the loads of its curves are normal forces in newtons,
/// not factors on the rest loads that are given.
[[nodiscard]] inline bool in_newtons(const ReducedModel& model) {
  return std::ranges::all_of(model.patches, [](const contact::Patch& patch) {
    return patch.load_measure == contact::LoadMeasure::force;
  });
}

/// Whether the surfaces of any patch are rough.
[[nodiscard]] inline bool is_rough(const ReducedModel& model) {
  return std::ranges::any_of(
      model.patches, [](const contact::Patch& patch) { return patch.rules.roughness.has_value(); });
}

}  // namespace microslip::pipelines
