/// @file
/// A contact point with one tangential direction under periodic motion of any number of harmonics:
/// the steady friction cycle found event by event, exact to rounding (theory sections 3 to 8).
///
///   n = max(0, n₀' + k_v v),   f = k_u (u − s),   |f| ≤ μ n,   s moves only where |f| = μ n    (1)
///
/// w is ignored and f_r = 0. A point that never slips nor separates has a virgin slider, pushed
/// into its admissible band (section 4.2). With one harmonic this is friction_cycle(),
/// by another road.
///
/// Accuracy: force coefficients within a few 1e-16 per phase of k_u |u| + μ (|n₀| + k_v |v|), where
/// |·| sums the amplitudes of the harmonics. Phases have square roots where events meet and are
/// only that accurate there; forces are not affected. Derivatives are one-sided at full stick and
/// where contact only just begins or ends.
///
/// Cost: a few µs per point for three harmonics with Jacobian,
/// growing with H² and the number of phases.
#pragma once

#include "contact/point/point_method.hpp"
#include "contact/surface/point_parameters.hpp"

namespace microslip::contact {

class LineEvents final : public PointMethod {
 public:
  /// @param point  constants, in the ranges of ContactPatch.
  explicit LineEvents(const PointParameters& point) : point_(point) {}

  void traction(const Harmonics& motion, double frequency, PointTraction& result) const override;
  void states(const Harmonics& motion, double frequency, PointTraction& result) const override;
  /// Events are those of the motion: its harmonics are paid for, not those of the force.
  [[nodiscard]] Harmonics force_up_to(const Harmonics& motion, double frequency,
                                      int n_harmonics) const override;
  [[nodiscard]] PointHistory history(const Harmonics& motion, double frequency,
                                     const Eigen::VectorXd& phases, int n_harmonics) const override;
  /// (k_u or 0, k_v, 0).
  [[nodiscard]] Eigen::Vector3d stuck_stiffness() const override;
  [[nodiscard]] double reference_load() const override;
  [[nodiscard]] std::optional<LinearRange> linear_range() const override;

 private:
  PointParameters point_;
};

}  // namespace microslip::contact
