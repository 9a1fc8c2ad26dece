/// @file
/// Where a contact point is known to answer like springs, or not at all,
/// whatever method finds its cycles:
///
///   open    n₀' + k_v v < 0 throughout              force 0
///   stuck   |K x| ≤ μ (n₀' + k_v v) throughout      force K x, load n₀' + k_v v, means too     (1)
///
/// with x = (u, w), K = diag(k_u, k_w), mean motion included. Under (1) the virgin slider s = 0 is
/// never pushed: it is inside its interval, or its ellipse, at every phase (theory sections 3, 4.2,
/// 9). For one tangential direction that is full stick with a mean force at no end of its interval.
///
/// Sums of amplitudes decide most points. For the others (1) is formed at M phases; between two of
/// them a polynomial rises above its larger value there by at most
///
///   ½ (π/M)² Σ_h h² amplitude_h                                                                (2)
///
/// as its slope vanishes at its maximum; |K x| − μ k_v v is the largest of polynomials e·K x − μ
/// k_v v, |e| = 1.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "contact/surface/friction_law.hpp"

namespace microslip::contact {

enum class SleepState : std::uint8_t { awake, stuck, open };

/// Constants of (1) for one point.
struct LinearRange {
  /// k_u, k_v, k_w [N/m³]; k_u = k_w = 0 where there is no friction.
  Eigen::Vector3d stiffness = Eigen::Vector3d::Zero();
  /// n₀' [Pa]. Where the point does not stick linearly its sign and that of n₀' + k_v v matter
  /// alone.
  double rest_load = 0.0;
  FrictionLaw friction = FrictionLaw::constant(0.0);  ///< μ(σ), monotone
  bool sticks_linearly =
      true;  ///< false: stiffness depends on the load; only an open point is linear

  [[nodiscard]] bool rubs() const { return stiffness[0] > 0.0 || stiffness[2] > 0.0; }
};

/// Functions of the Fourier convention at the phases of (2), in an order in which neighbours are
/// far apart: where (1) is broken for a part of the period one of the first shows it.
struct PhaseTable {
  PhaseTable() = default;
  /// @param harmonics  H ≥ 1; M = 16 (H + 1).
  explicit PhaseTable(int harmonics);

  int n_harmonics = 0;
  Eigen::MatrixXd basis;  ///< (2H+1) × M
  double rise = 0.0;      ///< ½ (π/M)²
};

/// Motion of one point: rows of harmonics, 2H + 1 numbers each [m].
struct PointRows {
  const double* u = nullptr;
  const double* v = nullptr;
  const double* w = nullptr;  ///< null: no motion along r
};

/// Load that (1) has to spare [Pa], ≥ 0: μn − |K x| where stuck (n itself where nothing rubs),
/// −n where open.
struct LinearReserve {
  double stuck = 0.0;
  double open = 0.0;
};

/// What motions may use up that are off by no more than this at any phase.
/// @param reach  along p, q, r [m].
[[nodiscard]] LinearReserve reserve_of_reach(const LinearRange& range,
                                             const Eigen::Vector3d& reach);

/// What all motions of a ball ‖Δx‖ ≤ radius [m√kg] over all modal unknowns may use up:
/// |Δx(θ)| ≤ ‖φ‖ √(1+H) ‖Δx‖.
/// @param sizes  ‖φ_u‖, ‖φ_v‖, ‖φ_w‖ at the point [1/√kg].
[[nodiscard]] LinearReserve reserve_of_ball(const LinearRange& range, const Eigen::Vector3d& sizes,
                                            int n_harmonics, double radius);

/// What the point is proved to do with this reserve, by more than rounding.
/// @param table      for the harmonics of the motion.
/// @param frequency  ω [rad/s]; matters where μ depends on the speed.
[[nodiscard]] SleepState sleep_state(const LinearRange& range, const PointRows& motion,
                                     const PhaseTable& table, double frequency,
                                     const LinearReserve& reserve = {});

}  // namespace microslip::contact
