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

/// By friction [J]: the work of the contact's force, or where its law has no such identity (rough
/// surfaces, ModalForce::work_error()) what slides.
/// @param work  of the force.   @param slip_work  of ModalForce::report().
[[nodiscard]] double dissipated(HarmonicBalance& balance, const Harmonics& q, double frequency,
                                double work, double slip_work);

/// Of a solution of the balance; two evaluations of its contact.
/// @param x          unknowns of `balance`.
/// @param frequency  ω [rad/s].
[[nodiscard]] PeriodEnergy period_energy(HarmonicBalance& balance, const Eigen::VectorXd& x,
                                         double frequency);

}  // namespace microslip::solver
