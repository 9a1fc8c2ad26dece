/// @file
/// The door between solver and contact: a nonlinear force as the solver sees it. Harmonics of the
/// modal coordinates go in, modal force and derivatives come out; behind it the solver cannot see
/// how. A cubic spring in a test serves the solver as well as a friction damper.
///
/// Sign (theory section 13): the force stands on the left side,
///
///   (Ω − k²ω² + ikωC_r) A^(k) + G^(k)(B, A) = Q^(k),        Ω B + G_b(B, A) = Q_b.
#pragma once

#include <Eigen/Core>

#include "contact/harmonics.hpp"

namespace microslip::contact {

/// G and its derivatives at one iterate; n = (2H+1) · n_modes unknowns in the order of
/// Harmonics::vector().
struct ForceAndJacobian {
  Harmonics force;                       ///< G [N/√kg]
  Eigen::MatrixXd jacobian;              ///< ∂G/∂q [1/s²], n × n
  Eigen::VectorXd frequency_derivative;  ///< ∂G/∂ω at fixed q, n; zero unless rate-dependent
  /// Largest ‖δG‖ by which G may be off because a law did not meet its own tolerance [N/√kg]. Whoever
  /// judges a residual adds it.
  double defect = 0.0;
};

/// What one solution did over its period: judged once per accepted point, not per iterate.
struct CycleReport {
  double stick_share = 0.0;         ///< fraction of (contact area × period), the three sum to 1
  double slip_share = 0.0;          ///< (0, 0, 0) when the force knows no contact
  double separated_share = 0.0;
  double three_states_share = 0.0;  ///< largest over the phase of the smallest area fraction
  double slip_work = 0.0;           ///< ∬∮ μ n |ds| dA [J per period], from the slip phases
  double awake_share = 1.0;         ///< fraction of the points that were evaluated one by one
};

/// What a force is known to be over a set of motions: its linear limit, stuck or free, exactly.
enum class LinearState { unknown, stuck, free };

class ModalForce {
 public:
  ModalForce() = default;
  ModalForce(const ModalForce&) = delete;
  ModalForce& operator=(const ModalForce&) = delete;
  ModalForce(ModalForce&&) = delete;
  ModalForce& operator=(ModalForce&&) = delete;
  virtual ~ModalForce() = default;

  [[nodiscard]] virtual Eigen::Index n_modes() const = 0;
  /// @param q          harmonics of the modal coordinates [m√kg].
  /// @param frequency  ω [rad/s].
  [[nodiscard]] virtual ForceAndJacobian evaluate(const Harmonics& q, double frequency) const = 0;
  /// Shares of the states and work of slip for a solution.
  [[nodiscard]] virtual CycleReport report(const Harmonics& q, double frequency) const = 0;
  /// Linear limit with every point stuck [1/s², n_modes × n_modes]; the free limit is zero.
  [[nodiscard]] virtual Eigen::MatrixXd stuck_stiffness() const = 0;
  /// What is proved of all motions within ‖Δx‖ ≤ radius of a centre [m√kg]; unknown unless overridden.
  [[nodiscard]] virtual LinearState linear_state(const Harmonics& /*centre*/,
                                                 double /*radius*/) const {
    return LinearState::unknown;
  }
};

}  // namespace microslip::contact
