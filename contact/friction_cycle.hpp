/// @file
/// Steady friction cycle of one contact point under single-harmonic motion, in closed form
/// (theory sections 4 to 7).
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include <Eigen/Core>

#include "contact/contact_patch.hpp"

namespace microslip::contact {

/// Relative motion u = u₀ + u_s sin θ + u_c cos θ along p, v likewise along q (v > 0: approach) [m].
struct PointMotion {
  double u_mean = 0.0;
  double u_sin = 0.0;
  double u_cos = 0.0;
  double v_mean = 0.0;
  double v_sin = 0.0;
  double v_cos = 0.0;
};

/// Values as written to files (interfaces.md section 3.2); `slip` is slip in two directions.
enum class ContactState : std::uint8_t { stick, positive_slip, negative_slip, separated, slip };
enum class CycleRegime : std::uint8_t { full_stick, stick_slip, separation, separated };

/// start in [0, 2π), length in (0, 2π] [rad].
struct CycleSegment {
  ContactState state = ContactState::stick;
  double start = 0.0;
  double length = 0.0;
};

/// mean, sin θ and cos θ coefficients [Pa].
struct ForceCoefficients {
  double mean = 0.0;
  double sin = 0.0;
  double cos = 0.0;
};

/// Rows: friction mean, sin, cos, normal mean, sin, cos. Columns: u_mean, u_sin, u_cos, v_mean,
/// v_sin, v_cos.
using CycleJacobian = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;

struct FrictionCycle {
  CycleRegime regime = CycleRegime::separated;
  ForceCoefficients friction;      ///< f, resists u
  ForceCoefficients normal;        ///< n ≥ 0, the whole load (not n − n_ref)
  CycleJacobian jacobian;          ///< [N/m³]
  double dissipated_energy = 0.0;  ///< ∮ μ n |ds| over the slip phases [J/m² per period]
  double slip_distance = 0.0;      ///< ∮ |ds| in contact [m per period]
  double normal_slip = 0.0;        ///< ∮ n |ds| [Pa·m]: Archard depth is K times this
  [[nodiscard]] std::span<const CycleSegment> segments() const { return {segment_, n_segments_}; }

  CycleSegment segment_[8];        // at most six occur (theory section 4.4)
  std::size_t n_segments_ = 0;
};

[[nodiscard]] FrictionCycle friction_cycle(const PointParameters& point, const PointMotion& motion);

}  // namespace microslip::contact
