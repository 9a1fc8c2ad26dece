/// @file
/// Steady friction cycle of one contact point under single-harmonic motion, in closed form
/// (theory sections 4 to 7).
///
/// The point is a tangential spring k_u in series with a slider of limit μ n, and a one-sided
/// normal spring k_v:
///
///   n(θ) = max(0, n₀ + k_v v),   f = k_u (u − s),   |f| ≤ μ n,   n₀ = n₀' + k_v v₀             (1)
///
/// and s moves only where |f| = μ n. The loop depends on history only where the point never slips
/// nor separates; there the slider starts virgin, s = 0, and is pushed into its admissible band:
///
///   f = k_u (u_s sin θ + u_c cos θ) + clip(k_u u₀; L₂ − q, q − L₁)                             (2)
///
/// u₀ acts through (2) alone. Degenerate points: k_u = 0 carries no friction and counts as stuck
/// wherever it is in contact; μ = 0 slips without force.
///
/// Accuracy: coefficients within a few 1e-16 of k_u a + μ (|n₀| + B) in every regime and limit
/// (a tangential amplitude, B = k_v b), and of the force itself where a point sticks for a short
/// time. Transition angles have square roots at the limits between regimes and are only that
/// accurate there; forces are not affected. The derivatives are those of (1), (2); they jump or
/// grow without bound, one-sided, at the limits of full stick and at grazing contact.
///
/// Source: theory sections 4–7; the closed form is that of the 2D microslip model with normal load
/// variation, equations 19–29, with the misprints corrected and free of 0/0.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include <Eigen/Core>

#include "contact/contact_state.hpp"
#include "contact/point/point_motion.hpp"
#include "contact/surface/point_parameters.hpp"

namespace microslip::contact {

/// mean, sin θ and cos θ coefficients [Pa].
struct ForceCoefficients {
  double mean = 0.0;
  double sin = 0.0;
  double cos = 0.0;
};

/// Rows: friction mean, sin, cos, normal mean, sin, cos. Columns: u_mean, u_sin, u_cos, v_mean,
/// v_sin, v_cos.
using CycleJacobian = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;

/// Forces and the entries of their Jacobian that can differ from zero [Pa, N/m³].
struct CycleForce {
  CycleRegime regime = CycleRegime::separated;
  ForceCoefficients friction;   ///< f, resists u
  ForceCoefficients normal;     ///< n ≥ 0, the whole load (not n − n_ref)
  double mean_by_u_mean = 0.0;  ///< ∂f_mean/∂u_mean: k_u while (2) does not clip, else 0
  std::array<std::array<double, 2>, 3> friction_by_u{};  ///< rows mean, sin, cos; columns u_s, u_c
  std::array<std::array<double, 3>, 3> friction_by_v{};  ///< columns v_mean, v_s, v_c
  std::array<std::array<double, 3>, 3> normal_by_v{};    ///< columns v_mean, v_s, v_c
};

struct FrictionCycle {
  CycleRegime regime = CycleRegime::separated;
  ForceCoefficients friction;      ///< f, resists u
  ForceCoefficients normal;        ///< n ≥ 0, the whole load (not n − n_ref)
  CycleJacobian jacobian;          ///< [N/m³]
  double dissipated_energy = 0.0;  ///< ∮ μ n |ds| over the slip phases [J/m² per period]
  double slip_distance = 0.0;      ///< ∮ |ds| in contact [m per period]
  double normal_slip = 0.0;        ///< ∮ n |ds| [Pa·m]: Archard depth is K times this
  /// States in order of time from the smallest start; neighbours differ, lengths sum to 2π.
  [[nodiscard]] std::span<const CycleSegment> segments() const {
    return {segment_.data(), n_segments_};
  }

  std::array<CycleSegment, 8> segment_;  // at most six occur (theory section 4.4)
  std::size_t n_segments_ = 0;
};

/// Everything about the steady cycle of one point.
/// @param point   constants, in the ranges of ContactPatch.
/// @param motion  finite.
/// @note Constant load and u = a sin θ with k_u a > μ n₀: D = 4 μ n₀ (a − μ n₀ / k_u).
[[nodiscard]] FrictionCycle friction_cycle(const PointParameters& point, const PointMotion& motion);

/// One point at one instant.
struct CycleInstant {
  ContactState state = ContactState::stick;
  double u = 0.0;         ///< mean included [m]
  double v = 0.0;         ///< mean included [m]
  double normal = 0.0;    ///< n [Pa]
  double friction = 0.0;  ///< f [Pa]
  double slider = 0.0;    ///< s [m]: u − f/k_u; rests at 0 where k_u = 0
};

/// @param cycle  friction_cycle(point, motion).   @param phase  θ [rad], any.
[[nodiscard]] CycleInstant at_phase(const FrictionCycle& cycle, const PointParameters& point,
                                    const PointMotion& motion, double phase);

}  // namespace microslip::contact
