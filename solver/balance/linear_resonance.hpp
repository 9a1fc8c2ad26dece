/// @file
/// Resonances without damping: there the response of a linear structure has no bound.
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

}  // namespace microslip::solver
