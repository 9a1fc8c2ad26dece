/// @file
/// Energies of one period of a motion in harmonics:
///
///   W      = π Σ_k k (A_s·F_c − A_c·F_s)        work of a force F on the motion, or taken by it
///   W_damp = π ω Σ_k k² Σ_n 2ζ_n ω_n |A_n|²     viscous damping
#pragma once

#include <Eigen/Core>

#include "solver/balance/harmonic_balance.hpp"
#include "solver/response_curve.hpp"

namespace microslip::solver {

/// W [J].
[[nodiscard]] double period_work(const Harmonics& q, const Harmonics& force);

/// W_damp [J], ≥ 0.
[[nodiscard]] double damping_work(const Harmonics& q, const Scene& scene, double frequency);

/// Of a solution of the balance; one evaluation of its contact, events located.
/// @param x          unknowns of `balance`.
/// @param frequency  ω [rad/s].
[[nodiscard]] PeriodEnergy period_energy(HarmonicBalance& balance, const Eigen::VectorXd& x,
                                         double frequency);

}  // namespace microslip::solver
