/// @file
/// How a motion near one that was integrated over a period ends it, to first order, where the force
/// of held contact states is linear and no force jumps between them:
/// friction along a line with a constant coefficient.
///
///   x = (q, q̇/w, s),   x' = A_k x,   D(T) = … S_2 e^{A_2 Δt_2} S_1 e^{A_1 Δt_1} D(0)          (1)
///
/// while the states k are held. S_k is the identity but for sliders that come to rest at the end of
/// states k, s = σ(q):
///
///   after slip          its rate vanishes there:     δs = ∇σ·δq                             (2)
///   after separation    g(q) = 0 at another instant: δs = ∇σ·δq − (∇σ·q̇)(∇g·δq)/(∇g·q̇)  (3)
///
/// Source: saltation matrices as in Leine & Nijmeijer, Dynamics and Bifurcations of Non-Smooth
/// Mechanical Systems (2004), section 7; the flow itself is continuous here. Follows one period
/// where differences take two per column.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "solver/time/time_stepper.hpp"

namespace microslip::solver {

/// Part of a period over which contact states are held.
struct HeldPart {
  double duration = 0.0;   ///< [s]
  TransientMemory memory;  ///< states and sliders within it
  ModalMotion end;         ///< of the motion that was integrated
};

/// Changes of a TimeState, a column each.
struct Variation {
  Eigen::MatrixXd q;         ///< n_modes rows [m√kg]
  Eigen::MatrixXd velocity;  ///< n_modes rows [m√kg/s]
  Eigen::MatrixXd slider;    ///< n_points rows [m]; of points that are not stuck anything
};

/// (1).
/// @param system  without contact, or with one that is_held_linear().
/// @param parts   of one period, in order. @param end  memory after it.
/// @param begin   changes at θ = 0.
/// @return        changes a period later; not finite where contact begins or ends at no speed.
[[nodiscard]] Variation varied_period(const TimeSystem& system, const std::vector<HeldPart>& parts,
                                      const TransientMemory& end, Variation begin);

}  // namespace microslip::solver
