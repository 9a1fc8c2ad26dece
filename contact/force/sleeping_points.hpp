/// @file
/// Points of a patch proved stuck, or open, for the whole cycle: they are linear, so that one matrix
/// stands for all of them and only the others are evaluated one by one (theory section 4.1, 4.2).
///
/// At a reference motion a point has a margin to the end of its state,
///
///   stuck:  min( n₀ − B,  2q − L₁ − L₂,  k_u u₀ − (L₂ − q),  (q − L₁) − k_u u₀ ) > 0              (1)
///   open:   −(n₀ + B) > 0                                                                        (2)
///
/// and each margin changes by at most c ‖Δx‖ when the modal motion changes by Δx: within the radius
/// margin / c the point stays what it is, without being looked at. Points are kept in the order of their
/// radius, those that may move first, and the linear parts as sums over the ends of that order. A stuck
/// point whose mean force is at an end of its interval is not asleep: its mean is not linear.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "contact/closed_form/friction_cycle.hpp"
#include "contact/contact_patch.hpp"
#include "contact/harmonics.hpp"
#include "contact/surface/linear_range.hpp"

namespace microslip::contact {

struct SleepProof {
  SleepState state = SleepState::awake;
  double radius = 0.0;  ///< ‖Δx‖ over all modal unknowns that cannot change the state [m√kg]
};

/// @param size_u, size_v  Euclidean norms of the mode shapes of the point [1/√kg].
[[nodiscard]] SleepProof prove_asleep(const PointParameters& point, const PointMotion& motion,
                                      double size_u, double size_v);

/// G and ∂G of the points that sleep: the same linear law on every harmonic, and a constant mean.
struct SleepingPart {
  Eigen::MatrixXd stiffness;  ///< [1/s²], n_modes × n_modes
  Eigen::VectorXd mean;       ///< of preloads that are gone, and of gaps that are closed [N/√kg]
};

/// The order of the points and what sleeps in it, for one reference motion after another. Reference
/// motions are chosen here: a new one when too many points have woken up, less often where it does
/// not pay.
class SleepingPoints {
 public:
  SleepingPoints(const ContactPatch& patch, const ModalShapes& shapes);

  /// Decides for this motion. @param q  H = 1.
  /// @return true: order() has changed.
  bool look_at(const Harmonics& q, const ContactPatch& patch, const ModalShapes& shapes);

  /// Point of each place; the first n_awake() are to be evaluated.
  [[nodiscard]] const std::vector<Eigen::Index>& order() const { return order_; }
  [[nodiscard]] Eigen::Index n_awake() const { return n_awake_; }
  /// Share of the points that would be evaluated one by one at this motion [-].
  [[nodiscard]] double awake_share_at(const Harmonics& q) const;
  /// Of the places from n_awake() on; nullptr: none sleeps.
  [[nodiscard]] const SleepingPart* part() const;

 private:
  void refer_to(const Harmonics& q, const ContactPatch& patch, const ModalShapes& shapes);
  void wake_all();
  void add_up(const std::vector<SleepProof>& proof, const ContactPatch& patch,
              const ModalShapes& shapes);
  [[nodiscard]] Eigen::Index awake_at(const Harmonics& q) const;

  Eigen::VectorXd size_u_, size_v_;
  Eigen::Index group_ = 0;  // places that fall asleep together
  std::vector<Eigen::Index> order_;
  std::vector<double> radius_;      // by place, ascending
  std::vector<SleepingPart> part_;  // of the places from group g on
  Harmonics reference_;
  Eigen::Index n_awake_ = 0;
  Eigen::Index n_awake_at_reference_ = 0;
  long calls_ = 0;
  long next_reference_ = 0;
  long patience_ = 1;
};

}  // namespace microslip::contact
