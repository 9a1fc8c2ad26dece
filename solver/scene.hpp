/// @file
/// What the solver solves: modes with damping, excitation, one nonlinear force, one output.
#pragma once

#include <memory>

#include <Eigen/Core>

#include "contact/harmonics.hpp"
#include "contact/modal_force.hpp"
#include "contact/transient_force.hpp"

namespace microslip::solver {

using contact::Harmonics;

/// (Ω − k²ω² + ikωC) A^(k) + G^(k) = Q^(k) in mass-normalised modal coordinates. Nothing that
/// solves it changes it: threads may share a scene, each with a HarmonicBalance of its own.
struct Scene {
  Eigen::VectorXd natural_frequency;                   ///< ω_n [rad/s], n_modes, ≥ 0
  Eigen::VectorXd damping_ratio;                       ///< ζ_n [-], n_modes
  Harmonics excitation;                                ///< Q [N/√kg], mean row included
  Eigen::VectorXd output;                              ///< y = output · q [1/√kg], n_modes
  std::unique_ptr<const contact::ModalForce> contact;  ///< nullptr: linear
  /// The same contact for time integration; nullptr: linear, or not offered by this contact.
  std::unique_ptr<const contact::TransientForce> transient;

  [[nodiscard]] Eigen::Index n_modes() const { return natural_frequency.size(); }
};

}  // namespace microslip::solver
