/// @file
/// The door between solver and contact: a nonlinear force as the solver sees it. Harmonics of the
/// modal coordinates go in, modal force and derivatives come out; behind it the solver cannot see
/// how. A cubic spring in a test serves the solver as well as a friction damper.
///
/// Sign (theory section 13): the force stands on the left side,
///
///   (Ω − k²ω² + ikωC_r) A^(k) + G^(k)(B, A) = Q^(k),        Ω B + G_b(B, A) = Q_b.
#pragma once

#include <utility>
#include <vector>

#include <Eigen/Core>

#include "contact/contact_states.hpp"
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
  double stick_share = 0.0;  ///< fraction of (contact area × period), the three sum to 1
  double slip_share = 0.0;   ///< (0, 0, 0) when the force knows no contact
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
  /// The same where only some harmonics are unknowns.
  /// @param rows  of Harmonics::rows(), ascending, any number; derivatives are by these and of these alone:
  ///              n = rows · n_modes. `force` has all rows of q.
  [[nodiscard]] virtual ForceAndJacobian evaluate_rows(
      const Harmonics& q, double frequency, const std::vector<Eigen::Index>& rows) const {
    ForceAndJacobian all = evaluate(q, frequency);
    const auto n = n_modes();
    const auto n_rows = static_cast<Eigen::Index>(rows.size());
    if (n_rows == q.rows().rows()) return all;
    ForceAndJacobian some{std::move(all.force), Eigen::MatrixXd(n_rows * n, n_rows * n),
                          Eigen::VectorXd(n_rows * n), all.defect};
    for (Eigen::Index i = 0; i < n_rows; ++i) {
      const Eigen::Index row = rows[static_cast<std::size_t>(i)] * n;
      some.frequency_derivative.segment(i * n, n) = all.frequency_derivative.segment(row, n);
      for (Eigen::Index j = 0; j < n_rows; ++j) {
        const Eigen::Index column = rows[static_cast<std::size_t>(j)] * n;
        some.jacobian.block(i * n, j * n, n, n) = all.jacobian.block(row, column, n, n);
      }
    }
    return some;
  }
  /// G alone, with harmonics that the motion does not have: what a motion asks of equations left out.
  /// @param n_harmonics  of the result, those of q at least.
  [[nodiscard]] virtual Harmonics force_up_to(const Harmonics& q, double frequency,
                                              int n_harmonics) const {
    Harmonics wide(n_harmonics, n_modes());
    wide.rows().topRows(q.rows().rows()) = q.rows();
    return evaluate_rows(wide, frequency, {}).force;
  }
  /// Shares of the states and work of slip for a solution.
  [[nodiscard]] virtual CycleReport report(const Harmonics& q, double frequency) const = 0;
  /// Linear limit with every point stuck [1/s², n_modes × n_modes]; the free limit is zero.
  [[nodiscard]] virtual Eigen::MatrixXd stuck_stiffness() const = 0;
  /// What is proved of all motions within ‖Δx‖ ≤ radius of a centre [m√kg]; unknown unless overridden.
  [[nodiscard]] virtual LinearState linear_state(const Harmonics& /*centre*/,
                                                 double /*radius*/) const {
    return LinearState::unknown;
  }

  /// What each point does under a motion: where the kind of its cycle changes the force has a kink. Costs
  /// next to nothing at the motion evaluated last.
  /// @param result  written whole, storage is used again; empty: not told.
  virtual void states(const Harmonics& /*q*/, double /*frequency*/, ContactStates& result) const {
    result.clear();
  }
};

}  // namespace microslip::contact
