/// @file
/// The door between time integration and contact: a force with memory as an integrator sees it.
///
/// The memory is a state (stick, slip, separated) and a slider for every point. An integrator uses
/// it in one of two ways:
///
///   trial and commit   trial_force() lets the slider give way without moving it, commit() moves it
///                      once per step (paper B, eq. 13 with the memory of theory section 18)
///   hold and switch    held_force() is the force of the states as they are, smooth in the motion;
///                      the guards say how far each state is from its end; switch_state() ends it.
///                      What a held state has to integrate beside the motion, such as the direction
///                      of slip in a plane, are internal variables: most forces have none
///
/// Sign as in modal_force.hpp: the force G stands on the left side, q̈ + C q̇ + Ω q + G = Q.
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "contact/contact_state.hpp"

namespace microslip::contact {

struct ModalMotion {
  Eigen::VectorXd q;         ///< modal displacement [m√kg], n_modes
  Eigen::VectorXd velocity;  ///< dq/dt [m√kg/s], n_modes
  /// d²q/dt² [m√kg/s²], n_modes; for internal_rates(), guards, switch_state() and slip_power() of
  /// forces that depend on the speed, without elements elsewhere.
  Eigen::VectorXd acceleration{};
};

struct TransientMemory {
  std::vector<ContactState> state;  ///< n_points
  /// s [m], n_points, or 2 n_points where friction acts in a plane: along p, then along r. Current
  /// where the state is stick; elsewhere the motion has dragged it on since.
  Eigen::VectorXd slider;
  /// Internal variables of the held states, n_internal(); anything where a state has none.
  Eigen::VectorXd internal{};
};

/// Sizes of the motion that make guards dimensionless.
struct GuardScale {
  double displacement = 0.0;  ///< largest ‖q‖ of a period [m√kg]
  double velocity = 0.0;      ///< largest ‖q̇‖ of a period [m√kg/s]
};

/// Fractions of the contact area; the three sum to 1.
struct StateShares {
  double stick = 0.0;
  double slip = 0.0;
  double separated = 0.0;
};

class TransientForce {
 public:
  static constexpr Eigen::Index guards_per_point = 2;
  using Guards = std::array<double, guards_per_point>;

  TransientForce() = default;
  TransientForce(const TransientForce&) = delete;
  TransientForce& operator=(const TransientForce&) = delete;
  TransientForce(TransientForce&&) = delete;
  TransientForce& operator=(TransientForce&&) = delete;
  virtual ~TransientForce() = default;

  [[nodiscard]] virtual Eigen::Index n_modes() const = 0;
  [[nodiscard]] virtual Eigen::Index n_points() const = 0;
  /// Before vibration begins: sliders at 0, nothing dynamic in the force at q = 0.
  [[nodiscard]] virtual TransientMemory virgin_memory() const = 0;

  /// G with sliders that give way where they must, without moving them [N/√kg, n_modes].
  [[nodiscard]] virtual Eigen::VectorXd trial_force(const ModalMotion& motion,
                                                    const TransientMemory& memory) const = 0;
  /// Moves the sliders to where the motion pushes them and names the states.
  /// @return work of the sliders [J], the friction at the end times the way.
  virtual double commit(const ModalMotion& motion, TransientMemory& memory) const = 0;

  /// G of the states as they are, also beyond their ends [N/√kg, n_modes].
  [[nodiscard]] virtual Eigen::VectorXd held_force(const ModalMotion& motion,
                                                   const TransientMemory& memory) const = 0;
  /// Whether held_force() is linear in the motion and in the sliders of stuck points and does not
  /// jump where a state ends: then a period is linearised by following its states once
  /// (solver/stability/period_variation.hpp).
  [[nodiscard]] virtual bool is_held_linear() const { return false; }
  /// How many internal variables held states have in all.
  [[nodiscard]] virtual Eigen::Index n_internal() const { return 0; }
  /// d/dt of the internal variables while the states are held, n_internal();
  /// 0 where a state has none.
  [[nodiscard]] virtual Eigen::VectorXd internal_rates(const ModalMotion& /*motion*/,
                                                       const TransientMemory& /*memory*/,
                                                       const GuardScale& /*scale*/) const {
    return {};
  }
  /// What each internal variable means to the motion: errors of it count times this, n_internal(),
  /// > 0.
  [[nodiscard]] virtual Eigen::VectorXd internal_weights(const ModalMotion& /*motion*/,
                                                         const TransientMemory& /*memory*/,
                                                         const GuardScale& /*scale*/) const {
    return {};
  }
  /// Guards of all points, one row each, dimensionless and smooth while states are held: a state
  /// ends where one of its guards falls below zero.
  [[nodiscard]] virtual Eigen::Matrix<double, Eigen::Dynamic, guards_per_point> guards(
      const ModalMotion& motion, const TransientMemory& memory, const GuardScale& scale) const = 0;
  /// One row of guards().
  [[nodiscard]] virtual Guards guards_of(Eigen::Index point, const ModalMotion& motion,
                                         const TransientMemory& memory,
                                         const GuardScale& scale) const = 0;
  /// Signed distances of the motion to where the held force has a kink that no guard tells, each of
  /// order one where it matters: steps of full order end where one of them changes sign.
  /// Most forces have none.
  [[nodiscard]] virtual Eigen::VectorXd kink_distances(const ModalMotion& /*motion*/) const {
    return {};
  }
  /// Ends the state of a point and begins the next by the rules of theory section 3.
  virtual void switch_state(Eigen::Index point, const ModalMotion& motion,
                            TransientMemory& memory) const = 0;
  /// Power of the sliders, Σ w μ n |ds/dt| [W].
  [[nodiscard]] virtual double slip_power(const ModalMotion& motion,
                                          const TransientMemory& memory) const = 0;

  [[nodiscard]] virtual StateShares shares(const TransientMemory& memory) const = 0;
  /// Linear limit with every point stuck [1/s², n_modes × n_modes]: it bounds explicit steps.
  [[nodiscard]] virtual Eigen::MatrixXd stuck_stiffness() const = 0;
};

}  // namespace microslip::contact
