/// @file
/// Guards of a point over the whole period: continuous functions whose signs say what occurs at
/// some time of it (theory section 7). Zero lines of their values on a patch are the boundaries
/// between points that stick throughout and those that slip, that touch throughout and that
/// separate, that separate and stay open: found between points by interpolation of the guard,
/// never of a state number.
///
///   slip        min_s max_θ 2 (|f_s(θ)| − μ n(θ))                                          (1)
///   load        min_θ n*(θ) and max_θ n*(θ)                                                (2)
///
/// f_s is the force of a slider resting at s, n* is n, and what the springs would pull where open.
/// (1) is below 0 where some resting slider holds. In one direction and one harmonic it is L₁ + L₂
/// − 2μn₀, (2) are n₀ − B and n₀ + B. Where loads separate, (1) is above 0.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "contact/harmonics.hpp"
#include "contact/point/point_motion.hpp"
#include "contact/surface/surface_law.hpp"

namespace microslip::contact {

struct TransitionGuards {
  double slip = 0.0;           ///< (1) [Pa]: above 0 the point slips at some time
  double smallest_load = 0.0;  ///< (2) [Pa]: below 0 it is open at some time
  double largest_load = 0.0;   ///< (2) [Pa]: below 0 it is open throughout
};

/// One harmonic, one direction: to rounding.
[[nodiscard]] TransitionGuards transition_guards(const PointParameters& point,
                                                 const PointMotion& motion);

/// Any law and motion, by samples of the period and parabolas through the extreme ones: of the
/// forces to 1e-6 for a few harmonics in one direction, to 1e-3 in two. Slip without stiffness or
/// friction is that of (1) as it stands.
/// @param motion     three signals, H ≥ 1.
/// @param frequency  ω [rad/s], for friction that depends on the rate.
/// @param along_r    whether the second direction is simulated.
[[nodiscard]] TransitionGuards transition_guards(const SurfaceLaw& law, const Harmonics& motion,
                                                 double frequency, bool along_r);

}  // namespace microslip::contact
