/// @file
/// One step at a time along a solution branch R(x, p) = 0 by pseudo-arclength continuation (theory
/// section 16). The step chooses itself by curvature, Newton's effort and the distance to the next
/// kink of the force; what stalls is tried again by a ladder of remedies.
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "solver/balance/branch_factors.hpp"
#include "solver/balance/newton.hpp"
#include "solver/branch/branch_geometry.hpp"
#include "solver/branch/predictor.hpp"
#include "solver/branch/step_states.hpp"
#include "solver/diagnosis.hpp"

namespace microslip::solver {

/// Scaling for the next step at an accepted point.
using ScalingRule = std::function<Scaling(const NewtonResult& at)>;

/// A point of the last step.
struct StepPoint {
  double share = 0.0;  ///< of the way along the chord from before() to now(), 0 … 1
  WalkerPoint point;
};

/// What helped where Newton's method had failed, and where.
struct StepRemedy {
  double parameter = 0.0;
  Remedy remedy = Remedy::shorter_step;
};

/// Why no step was possible.
enum class Stall { newton, fold, chatter };

class BranchWalker {
 public:
  /// @param start      converged.
  /// @param forward    sign of the parameter's first change, 1 or −1.
  /// @param tolerance  of the residual of every point, as in NewtonOptions.
  BranchWalker(ParametricSystem system, ScalingRule rule, NewtonResult start, double forward,
               double tolerance = NewtonOptions{}.tolerance);

  /// Steps are chosen by what the contact does as well (step_states.hpp).
  void watch(StateReader reader) { states_ = StepStates(std::move(reader)); }

  /// Steps are corrected with one Jacobian each, from the factors of the point before
  /// (few_jacobians.hpp).
  /// @param residual  of the same system, may leave the derivatives empty.
  void economise(ParametricSystem residual) { residual_ = std::move(residual); }

  /// Steps that swerve are taken: they may go over folds.
  void take_swerves() { takes_swerves_ = true; }

  /// One accepted step. False: no remedy helped; now() is the last good point.
  [[nodiscard]] bool advance();

  [[nodiscard]] const WalkerPoint& now() const { return now_; }
  [[nodiscard]] const WalkerPoint& before() const { return before_; }
  /// The branch where it passes the plane across the chord from before() to now() at a share of the
  /// way: Newton's method from the cubic through two points of the step with their tangents, then
  /// from the tangents and from the line between the points.
  /// @param a, b  of the last step, on either side of the share.
  /// @return empty: Newton's method failed from all of them.
  [[nodiscard]] std::optional<StepPoint> between(const StepPoint& a, const StepPoint& b,
                                                 double share);
  /// Where the last step has left a kink to another direction:
  /// before(), which is as near to it as the shortest step, with the tangent of the part ahead.
  /// From its own, between() finds the part that was walked.
  [[nodiscard]] const std::optional<WalkerPoint>& kink() const { return kink_; }
  /// Whether the last step went from one part of the branch to another that comes back beside it:
  /// planes across its chord meet both, and the tip may lie beyond its ends.
  [[nodiscard]] bool is_at_tip() const { return at_tip_; }
  /// Share of a step below which places on it differ by the errors of the force alone.
  [[nodiscard]] double resolution() const;
  /// Of a force that is sampled, whose Jacobian is dear.
  [[nodiscard]] bool is_sampled() const { return static_cast<bool>(residual_); }
  /// The solution at a fixed parameter near now() and before(), from the share of the way given.
  [[nodiscard]] NewtonResult at_parameter(double parameter, double share);

  [[nodiscard]] long evaluations() const { return evaluations_; }
  [[nodiscard]] long iterations() const { return iterations_; }
  [[nodiscard]] const std::vector<StepRemedy>& remedies() const { return remedies_; }
  /// What the step control has seen of the contact.
  [[nodiscard]] const StepStates& states() const { return states_; }
  /// After advance() was false.
  [[nodiscard]] Stall stall();

 private:
  struct Trial {
    WalkerPoint point;
    double cosine = -1.0;     ///< between the old and the new tangent
    double correction = 0.0;  ///< distance from predictor to corrected point, over the step
    double orientation = 0.0;
    bool converged = false;
    bool tip = false;   ///< the branch comes back beside itself, against the step
    bool bent = false;  ///< another branch crosses this one, at a kink of it
  };

  /// Of Newton's method, at most.
  struct Effort {
    int iterations;
    int evaluations;  ///< not of sampled forces
  };
  static constexpr int any_number = std::numeric_limits<int>::max();
  static constexpr Effort forces_alone{0, any_number};
  /// Of a step that may be halved: one in a thousand of those that converge takes more than nine
  /// evaluations, and those that do not would take forty.
  static constexpr Effort usual{10, 12};

  /// From now() along its tangent, or along another direction that leaves a kink.
  [[nodiscard]] Trial attempt(double length, Effort effort);
  [[nodiscard]] Trial attempt(const BranchVector& direction, double length, Effort effort);
  /// On the plane across `direction` through the predicted point, `length` away.
  [[nodiscard]] Trial corrected(const BranchVector& predicted, const BranchVector& direction,
                                double length, Effort effort);
  [[nodiscard]] bool smooth(const Trial& trial) const;
  [[nodiscard]] double swerve(const Trial& trial) const;
  [[nodiscard]] bool is_elsewhere_halfway(const Trial& trial);
  [[nodiscard]] Trial behind(const Trial& trial);
  [[nodiscard]] std::optional<bool> beyond_a_tip(const Trial& trial);
  [[nodiscard]] bool crosses_bent(const Trial& trial);
  void accept(Trial trial);
  void choose_step(const Trial& trial);
  /// The trial, or a shorter one that changes fewer states. @param distance  of the trial.
  [[nodiscard]] Trial limited(Trial trial, double distance);
  void remember(Remedy remedy);
  [[nodiscard]] bool leap();
  [[nodiscard]] bool turn_at_kink();
  [[nodiscard]] bool leave_kink(double orientation);
  [[nodiscard]] bool leave_kink(const BranchVector& way, double beyond, double orientation);
  [[nodiscard]] static bool is_other_part(const Trial& trial, double angle);
  [[nodiscard]] std::optional<WalkerPoint> corrected(const BranchVector& start,
                                                     const BranchVector& chord,
                                                     const WalkerPoint& nearby);
  [[nodiscard]] bool strays(const WalkerPoint& point, const BranchVector& chord) const;
  [[nodiscard]] NewtonResult solved(const BranchVector& predicted, const BranchVector& direction,
                                    const NewtonOptions& options, const WalkerPoint& nearby);

  ParametricSystem system_;
  ParametricSystem residual_;  ///< empty: Newton's method all the way
  bool takes_swerves_ = false;
  BranchPredictor predictor_;
  ScalingRule rule_;
  double tolerance_;
  WalkerPoint now_;
  WalkerPoint before_;
  double step_ = 0.05;
  double orientation_ = 0.0;  ///< 0: not known yet
  double before_orientation_ = 0.0;
  std::optional<WalkerPoint> kink_;  ///< of the last step
  bool at_tip_ = false;              ///< the same
  StepStates states_;
  std::vector<StepRemedy> remedies_;
  long evaluations_ = 0;
  long iterations_ = 0;
};

}  // namespace microslip::solver
