/// @file
/// Equations of motion of a scene at one frequency of excitation (theory section 18; paper B, eq.
/// 13):
///
///   q̈ = Q(θ) − C q̇ − Ω q − G,     θ = ωt,   C = 2 ζ_n ω_n,   Ω = ω_n²
///
/// G is left to the caller: trial or held force of the scene's TransientForce.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "solver/scene.hpp"

namespace microslip::solver {

using contact::ModalMotion;
using contact::TransientMemory;

/// Largest step over 1/|λ|, |λ| the largest of the stuck and of the free system, that fixed-step
/// integration accepts (theory section 18). The limit of fourth-order Runge–Kutta itself is 2√2 for
/// an undamped mode: a factor √2 is left.
inline constexpr double largest_step_ratio = 2.0;

/// @throws std::invalid_argument  the condition does not hold; the message says which.
void require_for_time(bool condition, const std::string& message);

class TimeSystem {
 public:
  /// @param scene  borrowed; must outlive this.   @param frequency  ω [rad/s], > 0.
  /// @throws std::invalid_argument  sizes in the scene differ, a value is not finite or out of
  ///         range, or the scene has contact that time integration cannot see.
  TimeSystem(const Scene& scene, double frequency);

  [[nodiscard]] const Scene& scene() const { return scene_; }
  [[nodiscard]] const contact::TransientForce* contact() const { return scene_.transient.get(); }
  [[nodiscard]] Eigen::Index n_modes() const { return stiffness_.size(); }
  [[nodiscard]] double frequency() const { return frequency_; }
  [[nodiscard]] double period() const;

  /// Q(ωt) [N/√kg].
  [[nodiscard]] Eigen::VectorXd excitation(double time) const;
  /// q̈ under a contact force G [N/√kg].
  [[nodiscard]] Eigen::VectorXd acceleration(double time, const ModalMotion& motion,
                                             const Eigen::VectorXd& contact_force) const;
  /// C q̇ [N/√kg].
  [[nodiscard]] Eigen::VectorXd damping_force(const Eigen::VectorXd& velocity) const {
    return damping_.cwiseProduct(velocity);
  }
  /// Largest |λ| of the stuck and of the free system [rad/s].
  [[nodiscard]] double largest_frequency() const { return largest_frequency_; }
  /// Steps per period below which fixed-step integration is refused.
  [[nodiscard]] int least_steps() const;
  /// ‖Q‖ over the period [N/√kg].
  [[nodiscard]] double excitation_size() const { return scene_.excitation.rows().norm(); }
  /// Whether Q varies over the period; else a damped motion comes to rest.
  [[nodiscard]] bool is_driven() const {
    const auto& rows = scene_.excitation.rows();
    return (rows.bottomRows(rows.rows() - 1).array() != 0.0).any();
  }

 private:
  const Scene& scene_;
  double frequency_;
  std::vector<int> driven_{};  ///< harmonics of the excitation
  Eigen::VectorXd stiffness_;
  Eigen::VectorXd damping_;
  double largest_frequency_ = 0.0;
};

}  // namespace microslip::solver
