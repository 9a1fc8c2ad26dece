/// @file
/// Whether a motion repeats itself: period by period, with period multiples 1 to 4.
///
/// The state at θ = 0, (q/|q|, q̇/|q̇|, G/|G|), is compared with the one m periods before. A motion
/// that approaches its limit like ρᵏ is still c/(1 − ρ) away from it when its change is c, so this,
/// with ρ from the last changes, is what is held against the tolerance:
///
///   d_m = c_m / (1 − ρ),    c_m = max of |Δq|, |Δq̇|, |ΔG| over their sizes
#pragma once

#include <array>
#include <cstddef>
#include <deque>

#include <Eigen/Core>

namespace microslip::solver {

struct PeriodState {
  Eigen::VectorXd q;              ///< [m√kg]
  Eigen::VectorXd velocity;       ///< [m√kg/s]
  Eigen::VectorXd contact_force;  ///< G [N/√kg]: sliders that moved show in it
  /// Largest ‖q‖ of the period, > 0 unless all is at rest. Of the largest period so far, as the
  /// other sizes, where nothing drives the motion: it would decay together with the changes.
  double displacement_size = 0.0;
  double velocity_size = 0.0;
  double force_size = 0.0;
};

class PeriodicityTest {
 public:
  static constexpr std::size_t largest_multiple = 4;

  /// Takes the state after one more period.
  void add(PeriodState state);
  /// Distance d_m to a motion of period m; infinite before it can be told.
  [[nodiscard]] double distance(std::size_t multiple) const;
  /// Smallest m with d_m below the tolerance; 0: none. m > 1 only where no divisor of m comes
  /// within a thousand tolerances: a decay that turns while it shrinks looks like m > 1 for a
  /// while.
  [[nodiscard]] int multiple(double tolerance) const;

 private:
  std::deque<PeriodState> states_;  // the latest last
  std::array<std::deque<double>, largest_multiple> changes_;
};

}  // namespace microslip::solver
