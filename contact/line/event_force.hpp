/// @file
/// Fourier coefficients of a steady cycle of many harmonics and their Jacobian, given its phases
/// (theory sections 5, 6, 8).
///
/// On each phase forces are trigonometric polynomials; with b_i the functions 1, sin θ, cos θ, sin
/// 2θ, … and ⟨·⟩ an integral over the phases named,
///
///   f_i = g_i [ Σ_j spring_j ⟨b_i b_j⟩_stick + Σ_j μ load_j (⟨b_i b_j⟩_P − ⟨b_i b_j⟩_N)
///               + Σ_stick c ⟨b_i⟩ ]
///   n_i = g_i Σ_j load_j ⟨b_i b_j⟩_contact,          g_0 = 1/2π, else 1/π
///
/// Force is continuous, so the Jacobian is the same sum with derivatives inside; each stick phase
/// brings the derivative of its memory c, which knows only the instant θ_e at which it was set:
///
///   after P, N   ∂c/∂u_j = −k_u b_j(θ_e),   ∂c/∂v_j = ± μ k_v b_j(θ_e)
///   after E      ∂c/∂u_j = −k_u b_j(θ_e),   ∂c/∂v_j = (spring'/load') k_v b_j(θ_e)
///
/// u₀ acts only where a virgin slider sticks throughout.
#pragma once

#include "contact/line/event_phases.hpp"
#include "contact/numerics/trigonometric_moments.hpp"
#include "contact/point/point_method.hpp"

namespace microslip::contact {

/// `regime` and `period` of the result.
void set_states(const EventPhases& phases, PointTraction& result);

/// Forces and Jacobian of phases; keeps its storage for the next ones.
class EventForce {
 public:
  /// f_p and n; f_r is 0. @param n_harmonics  of the forces, ≥ 0.
  [[nodiscard]] Harmonics force(const PointParameters& point, const EventGuards& guards,
                                const EventPhases& phases, int n_harmonics);
  /// As many harmonics as the motion; `result` is written whole.
  void traction(const PointParameters& point, const EventGuards& guards, const EventPhases& phases,
                PointTraction& result);

 private:
  void gather(const PointParameters& point, const EventGuards& guards, const EventPhases& phases,
              int n_harmonics);
  void set_force(const PointParameters& point, const EventGuards& guards, Harmonics& force);
  void set_springs(const PointParameters& point, Eigen::MatrixXd& jacobian) const;
  void add_memories(const PointParameters& point, const EventGuards& guards,
                    const EventPhases& phases, Eigen::MatrixXd& jacobian);

  bool rubs_ = false;
  int n_harmonics_ = 0;  // of the forces
  TrigonometricMoments piece_;
  TrigonometricMoments stick_;
  TrigonometricMoments slip_;  // positive minus negative
  TrigonometricMoments contact_;
  std::vector<double> memory_;      // Σ c ⟨b_i⟩
  std::vector<double> stick_mean_;  // ⟨b_i⟩ of each stick phase, one after the other
  std::vector<double> basis_;
};

}  // namespace microslip::contact
