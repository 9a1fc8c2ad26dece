/// @file
/// Resonances of a linear structure; without damping its response has no bound there.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "solver/scene.hpp"

namespace microslip::solver {

/// The first frequency on the way from begin to end [rad/s] at which a harmonic of the excitation
/// meets an undamped resonance that it moves.
/// @param stiffness  added to the modes, n_modes × n_modes [1/s²].
[[nodiscard]] std::optional<double> unbounded_resonance(const Scene& scene,
                                                        const Eigen::MatrixXd& stiffness,
                                                        double begin, double end);

/// Where harmonics of the excitation meet resonances of a linear structure.
struct DrivenResonances {
  Eigen::ArrayXd frequency;   ///< of the excitation [rad/s]
  Eigen::ArrayXd half_width;  ///< of the same, by damping [rad/s], to first order in it

  /// Distance in the complex plane of frequencies to the nearest [rad/s]; ∞: there is none.
  [[nodiscard]] double distance(double omega) const;
  /// The first on the way from one frequency to another, neither of them. Empty: there is none.
  [[nodiscard]] std::optional<double> first_within(double from, double to) const;
};

/// Those of shapes that a harmonic of the excitation drives.
/// @param stiffness  as of unbounded_resonance(), symmetric.
[[nodiscard]] DrivenResonances driven_resonances(const Scene& scene,
                                                 const Eigen::MatrixXd& stiffness);

}  // namespace microslip::solver
