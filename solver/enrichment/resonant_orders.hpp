/// @file
/// Harmonics of a solution that may resonate: what contact does to a mode is known between its
/// limits only, and one step from a solution without harmonic k knows one place of it.
#pragma once

#include <vector>

#include "solver/balance/harmonic_balance.hpp"
#include "solver/balance/newton.hpp"

namespace microslip::solver {

/// Orders k for which kω lies within three half bandwidths of a mode ψ_j, ω_j of the structure,
/// free, stuck, or with the contact stiffness of the solution's first harmonic,
/// and whose resonant response
///
///   |ψ_j · G^(k)| / (2 ζ_j ω_j kω)  ≥  least · ‖q^(1)‖
///
/// @param at     solved, evaluated with its Jacobian.
/// @param force  of the contact at this motion, up to the highest order asked about.
[[nodiscard]] std::vector<int> resonant_orders(const HarmonicBalance& balance,
                                               const BranchVector& at,
                                               const Eigen::MatrixXd& jacobian,
                                               const Harmonics& force, double least);

}  // namespace microslip::solver
