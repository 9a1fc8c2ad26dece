/// @file
/// Modal force of a patch whose points are evaluated while they slip or part, and are one matrix while they are
/// proved stuck or open (sleeping_set.hpp): what is the same however a point is evaluated (theory section 13).
///
///   G^(k)_m = Σ_i w_i [ φ_u,im f_p,i + φ_v,im (n_i − n_ref,i δ_k0) + φ_w,im f_r,i ]^(k)
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "contact/force/cycle_report.hpp"
#include "contact/force/sleeping_set.hpp"
#include "contact/modal_force.hpp"
#include "contact/patch.hpp"
#include "contact/surface/linear_range.hpp"

namespace microslip::contact {

/// What is known of the points of a patch before they move; n of each.
struct RestingPoints {
  Eigen::VectorXd weights;                         ///< area [m²], ≥ 0
  Eigen::VectorXd reference_load;                  ///< n_ref [Pa]
  Eigen::MatrixX3d stuck_stiffness;                ///< along p, q, r [N/m³]
  std::vector<std::optional<LinearRange>> ranges;  ///< none: always evaluated
};

class PointwiseForce : public ModalForce {
 public:
  [[nodiscard]] CycleReport report(const Harmonics& q, double frequency) final;
  /// At another motion than the last one: costs its evaluation, without derivatives by the modes.
  void states(const Harmonics& q, double frequency, ContactStates& result) final;
  [[nodiscard]] Eigen::MatrixXd stuck_stiffness() const final;
  /// Of any number of harmonics; unknown where a point has no range. See SleepingSet.
  [[nodiscard]] LinearState linear_state(const Harmonics& centre, double radius) const final;

 protected:
  /// @param shapes  relative mode shapes at the points, n × n_modes; w may be empty (no motion along r).
  /// @throws std::invalid_argument  sizes differ, a value is not finite, or no points.
  PointwiseForce(RestingPoints points, ModalShapes&& shapes);

  [[nodiscard]] const RestingPoints& points() const { return points_; }
  [[nodiscard]] const ModalShapes& shapes() const { return shapes_; }
  /// Of the evaluation under way: how all points move, and which are to be evaluated.
  [[nodiscard]] const PatchMotion& motion() const { return motion_; }
  [[nodiscard]] const std::vector<Eigen::Index>& awake() const { return sleep_.awake(); }
  /// Keeps what an awake point does under the motion.
  void keep(Eigen::Index point, const CycleStates& cycle);
  /// Linear in contact without friction: slip there has no force, and is not told.
  [[nodiscard]] bool is_frictionless(Eigen::Index point) const;

 private:
  /// Equal input gives equal bits, whatever was asked before.
  [[nodiscard]] ForceAndJacobian evaluated(const Harmonics& q, double frequency,
                                           const Asked& asked) final;
  /// Sum of the awake points under motion(). What they do is kept, but where more harmonics are asked for.
  [[nodiscard]] virtual ForceAndJacobian awake_force(double frequency, const Asked& asked) = 0;
  /// Cycles of these points under motion().
  virtual void add_cycles(std::span<const Eigen::Index> points, double frequency,
                          ReportSum& sum) = 0;

  void look_at(const Harmonics& q, double frequency);
  void keep_sleeping();

  RestingPoints points_;
  ModalShapes shapes_;
  SleepingSet sleep_;
  PatchMotion motion_;
  std::vector<CycleStates> cycles_;
  std::optional<Harmonics> kept_q_;  ///< the motion of cycles_; none: they are of no motion
  double kept_frequency_ = 0.0;
};

}  // namespace microslip::contact
