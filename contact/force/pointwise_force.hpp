/// @file
/// Modal force of a patch whose points are evaluated while they slip or part, and are one matrix
/// while they are proved stuck or open (sleeping_set.hpp): what is the same however a point is
/// evaluated (theory section 13).
///
///   G^(k)_m = Σ_i w_i [ φ_u,im f_p,i + φ_v,im (n_i − n_ref,i δ_k0) + φ_w,im f_r,i ]^(k)
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "contact/force/cycle_report.hpp"
#include "contact/force/sleeping_set.hpp"
#include "contact/modal_force.hpp"
#include "contact/patch.hpp"
#include "contact/surface/linear_range.hpp"

namespace microslip::contact {

class PointwiseForce : public ModalForce {
 public:
  [[nodiscard]] std::unique_ptr<Workspace> workspace() const override;
  [[nodiscard]] CycleReport report(const Harmonics& q, double frequency,
                                   Workspace& work) const final;
  /// Of each point: its precision of the smaller of what its springs would store and its friction
  /// would do, w π Σ k_s |x_s| |x_s'| and w π μ n Σ |x_s'|, of w π n |v'| where it may part, and
  /// rounding of all three; |x| and |x'| the sums of amplitudes, modes apart.
  [[nodiscard]] double work_error(const Harmonics& q, double frequency,
                                  Workspace& work) const final;
  /// At another motion than the last one: costs its evaluation, without derivatives by the modes,
  /// or less where states need less.
  void states(const Harmonics& q, double frequency, ContactStates& result,
              Workspace& work) const final;
  [[nodiscard]] Eigen::MatrixXd stuck_stiffness() const final;
  /// Of any number of harmonics; unknown where a point has no range.
  [[nodiscard]] LinearState linear_state_of(const MotionSet& motions) const final;

 protected:
  /// @param shapes  relative mode shapes at the points, n × n_modes;
  ///                w may be empty (no motion along r).
  /// @throws std::invalid_argument  sizes differ, a value is not finite, or no points.
  PointwiseForce(RestingPoints points, ModalShapes&& shapes);

  /// Forces that keep more of their own derive from it and override workspace().
  struct PointwiseWork : Workspace {
    explicit PointwiseWork(const PointwiseForce& force);

    PatchMotion motion;               ///< of the evaluation under way
    SleepingSet sleep;                ///< under it
    std::vector<CycleStates> cycles;  ///< of all points
    std::optional<Harmonics> kept_q;  ///< the motion of `cycles`; none: they are of no motion
    double kept_frequency = 0.0;
  };

  [[nodiscard]] const RestingPoints& points() const { return points_; }
  [[nodiscard]] const ModalShapes& shapes() const { return shapes_; }
  /// Keeps what an awake point does under the motion.
  void keep(Eigen::Index point, const CycleStates& cycle, PointwiseWork& work) const;
  /// Linear in contact without friction: slip there has no force, and is not told.
  [[nodiscard]] bool is_frictionless(Eigen::Index point) const;

  /// What a point's works may be off by beyond rounding, see work_error(); 0: events are located.
  struct WorkPrecision {
    double friction = 0.0;  ///< of the smaller of what its springs would store and friction do
    double load = 0.0;      ///< of load times path, where the point may part
  };

 private:
  /// Equal input gives equal bits, whatever was asked before.
  [[nodiscard]] ForceAndJacobian evaluated(const Harmonics& q, double frequency, const Asked& asked,
                                           Workspace& work) const final;
  /// Sum of the awake points under the motion at work. What they do is kept,
  /// but where more harmonics are asked for.
  /// @param work  of this force, as workspace() makes them; here and below.
  [[nodiscard]] virtual ForceAndJacobian awake_force(double frequency, const Asked& asked,
                                                     PointwiseWork& work) const = 0;
  /// Keeps what the awake points do under the motion at work, as close as states() needs it.
  virtual void find_states(double frequency, PointwiseWork& work) const {
    static_cast<void>(awake_force(frequency, {}, work));
  }
  /// Cycles of these points under the motion at work.
  virtual void add_cycles(std::span<const Eigen::Index> points, double frequency,
                          PointwiseWork& work, ReportSum& sum) const = 0;

  /// Of a point.
  [[nodiscard]] virtual WorkPrecision work_precision(Eigen::Index /*point*/,
                                                     int /*n_harmonics*/) const {
    return {};
  }

  /// @throws std::invalid_argument  it is of another force.
  [[nodiscard]] PointwiseWork& own(Workspace& work) const;
  void look_at(const Harmonics& q, double frequency, PointwiseWork& work) const;

  RestingPoints points_;
  ModalShapes shapes_;
};

}  // namespace microslip::contact
