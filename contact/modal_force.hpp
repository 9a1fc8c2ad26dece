/// @file
/// The door between solver and contact: a nonlinear force as the solver sees it. Harmonics of the
/// modal coordinates go in, modal force and derivatives come out; behind it the solver cannot see
/// how. A cubic spring in a test serves the solver as well as a friction damper.
///
/// Sign (theory section 13): the force stands on the left side,
///
///   (Ω − k²ω² + ikωC_r) A^(k) + G^(k)(B, A) = Q^(k),        Ω B + G_b(B, A) = Q_b.
#pragma once

#include <memory>
#include <vector>

#include <Eigen/Core>

#include "contact/contact_states.hpp"
#include "contact/harmonics.hpp"

namespace microslip::contact {

/// ∂G/∂q = Tᵀ K T of every pair of harmonic rows, where a force sees N modes through r coordinates.
struct FewerDerivatives {
  Eigen::MatrixXd of_modes;  ///< T, r × N
  Eigen::MatrixXd jacobian;  ///< K, rows · r square [1/s²]

  /// Tᵀ K T, rows · N square.
  [[nodiscard]] Eigen::MatrixXd expanded() const;
};

/// G and its derivatives at one iterate, by n = rows · n_modes unknowns: all of
/// Harmonics::vector(), in its order, or those asked for.
struct ForceAndJacobian {
  Harmonics force;                       ///< G [N/√kg]
  Eigen::MatrixXd jacobian;              ///< ∂G/∂q [1/s²], n × n
  Eigen::VectorXd frequency_derivative;  ///< ∂G/∂ω at fixed q, n; zero unless rate-dependent
  /// Largest ‖δG‖ by which G may be off because a method did not meet its own tolerance [N/√kg].
  /// Whoever judges a residual adds it.
  double defect = 0.0;
  /// In place of `jacobian`, which is empty then, where it is asked for and the force has it.
  std::shared_ptr<const FewerDerivatives> fewer{};
};

/// What one solution did over its period: judged once per accepted point, not per iterate.
struct CycleReport {
  double stick_share = 0.0;  ///< fraction of (contact area × period), the three sum to 1
  double slip_share = 0.0;   ///< (0, 0, 0) when the force knows no contact
  double separated_share = 0.0;
  double three_states_share = 0.0;  ///< largest over the phase of the smallest area fraction
  double slip_work = 0.0;           ///< ∬∮ μ n |ds| dA [J per period], from the slip phases
  double awake_share = 1.0;         ///< fraction of the points that were evaluated one by one
  /// Largest over the points of what the segments of a period overlap, leave open or turn back
  /// [rad]: rounding, where events are in order.
  double event_gap = 0.0;
};

/// What a force is known to be over a set of motions: its linear limit, stuck or free, exactly.
enum class LinearState { unknown, stuck, free };

/// Motions near one: every centre + Δx + Σ_j z_j spread_j.
struct MotionSet {
  Harmonics centre;     ///< [m√kg]
  double radius = 0.0;  ///< ‖Δx‖ over all modal unknowns at most; may be infinite: all there are
  Eigen::MatrixXd spread{};  ///< N × any number [m√kg], |z_j(θ)| ≤ 1 at every phase; empty: none
};

/// What is asked of the equations at a motion.
struct Asked {
  /// Rows of Harmonics::rows() by which to differentiate, ascending; none: the force alone, which
  /// is cheaper where points are sampled.
  std::vector<Eigen::Index> rows{};
  /// Of the force: what a motion asks of equations left out. Fewer than the motion has, e.g. 0:
  /// those of the motion. More: without derivatives.
  int n_harmonics = 0;
  bool fewer = false;  ///< derivatives may come as FewerDerivatives
};

/// A force does not change: what an evaluation leaves for the next lies in a workspace that the
/// caller owns.
class ModalForce {
 public:
  /// Storage, and what was found at the motion evaluated last. It saves time and decides no answer:
  /// equal questions give equal bits, whatever was asked before. Of one force,
  /// for one thread at a time.
  class Workspace {
   public:
    explicit Workspace(const ModalForce& owner) : owner_(&owner) {}
    Workspace(const Workspace&) = delete;
    Workspace& operator=(const Workspace&) = delete;
    Workspace(Workspace&&) = delete;
    Workspace& operator=(Workspace&&) = delete;
    virtual ~Workspace() = default;

    [[nodiscard]] bool is_of(const ModalForce& force) const { return owner_ == &force; }

   private:
    const ModalForce* owner_;
  };

  /// @param n_modes  of all motions asked for.
  explicit ModalForce(Eigen::Index n_modes) : n_modes_(n_modes) {}
  ModalForce(const ModalForce&) = delete;
  ModalForce& operator=(const ModalForce&) = delete;
  ModalForce(ModalForce&&) = delete;
  ModalForce& operator=(ModalForce&&) = delete;
  virtual ~ModalForce() = default;

  [[nodiscard]] Eigen::Index n_modes() const { return n_modes_; }
  /// A new one, of this force or of the one that answers in its place, which outlives it.
  [[nodiscard]] virtual std::unique_ptr<Workspace> workspace() const {
    return std::make_unique<Workspace>(*this);
  }

  /// The equations.
  /// @param q          harmonics of the modal coordinates [m√kg].
  /// @param frequency  ω [rad/s].
  /// @return           derivatives by the rows asked for and by these alone: n = rows · n_modes.
  /// @throws std::invalid_argument  another number of modes than n_modes(), harmonics that the
  ///                                force does not know, derivatives of more harmonics than the
  ///                                motion has. Of forces that keep anything there:
  ///                                a workspace of another.
  [[nodiscard]] ForceAndJacobian evaluate(const Harmonics& q, double frequency, const Asked& asked,
                                          Workspace& work) const;

  /// What a solution did: shares of the states and work of slip.
  /// @throws std::invalid_argument  as evaluate().
  [[nodiscard]] virtual CycleReport report(const Harmonics& q, double frequency,
                                           Workspace& work) const = 0;
  /// What `slip_work` of report() may differ by from the work of the force: rounding where events
  /// are located, what sampling leaves; infinite where the law has no such identity
  /// (rough surfaces, theory section 11). Asked where they differ.
  /// @return  [J per period], ≥ 0; 0 unless overridden: the two are the same.
  [[nodiscard]] virtual double work_error(const Harmonics& /*q*/, double /*frequency*/,
                                          Workspace& /*work*/) const {
    return 0.0;
  }
  /// What each point does under a motion: where the kind of its cycle changes the force has a kink.
  /// Costs next to nothing at the motion evaluated last with this workspace,
  /// elsewhere an evaluation.
  /// @param result  written whole, storage is used again; empty: not told.
  /// @throws std::invalid_argument  as evaluate().
  virtual void states(const Harmonics& /*q*/, double /*frequency*/, ContactStates& result,
                      Workspace& /*work*/) const {
    result.clear();
  }

  /// Linear limit with every point stuck [1/s², n_modes × n_modes]; the free limit is zero.
  [[nodiscard]] virtual Eigen::MatrixXd stuck_stiffness() const = 0;
  /// Whether it goes by the mean B of a motion. If not, ∂G/∂B = 0, and a balance gives B by the
  /// others.
  [[nodiscard]] virtual bool answers_mean() const { return true; }
  /// What is proved of all motions of a set. Unknown unless overridden.
  [[nodiscard]] virtual LinearState linear_state_of(const MotionSet& /*motions*/) const {
    return LinearState::unknown;
  }
  /// Of all within ‖Δx‖ ≤ radius of a centre.
  [[nodiscard]] LinearState linear_state(const Harmonics& centre, double radius) const {
    return linear_state_of({centre, radius});
  }

 private:
  /// See evaluate().
  [[nodiscard]] virtual ForceAndJacobian evaluated(const Harmonics& q, double frequency,
                                                   const Asked& asked, Workspace& work) const = 0;

  Eigen::Index n_modes_;
};

/// Of a force that is only known with all its derivatives: those asked for.
/// @param all  with derivatives by all its rows; as many harmonics as asked for, or the motion has.
[[nodiscard]] ForceAndJacobian restricted(ForceAndJacobian all,
                                          const std::vector<Eigen::Index>& rows);

}  // namespace microslip::contact
