/// @file
/// The phases of a steady friction cycle in order of time: which states follow one another and when
/// (theory sections 4.1 to 4.5).
///
/// Half-angle forms give the angles of slip d_P, d_N and the half angle of contact γ:
///
///   d_N = 2 atan2(√(L₁+L₂−2q), √(2q+ΔL)),   d_P = 2 atan2(√(L₁+L₂−2q), √(2q−ΔL)),  ΔL = L₂ − L₁
///   γ   = 2 atan2(√(B+n₀), √(B−n₀))
///
/// From the end of positive slip θ_P to the end of negative slip θ_N lies an angle η in (0, 2π];
/// the last d_N of it is slip, the rest stick. The way back takes 2π − η, of which the last d_P is
/// slip. Written so, a phase of zero length can never turn into a full turn by rounding, and no
/// tolerance is needed.
#pragma once

#include <array>
#include <cstdint>

#include "contact/closed_form/friction_cycle.hpp"
#include "contact/closed_form/slip_functions.hpp"

namespace microslip::contact {

/// A state together with where it came from, which decides the memory of a stick phase.
enum class PhaseKind : std::uint8_t {
  separated,
  positive_slip,
  negative_slip,
  stick_after_separation,
  stick_after_positive,
  stick_after_negative,
};

[[nodiscard]] ContactState state_of(PhaseKind kind);

struct CyclePhase {
  PhaseKind kind = PhaseKind::separated;
  Direction begin;           ///< angle at which it begins; it ends where the next one begins
  double length = 0.0;       ///< [rad], ≥ 0
  double to_extremum = 0.0;  ///< slip only: angle from its begin to θ_P or θ_N [rad]
};

/// All phases of one period, first to last; lengths sum to 2π. Phases of zero length may occur.
struct CyclePhases {
  std::array<CyclePhase, 8> phase;
  int n_phases = 0;

  void add(const CyclePhase& next) { phase[static_cast<std::size_t>(n_phases++)] = next; }
};

/// Regime by the order of theory section 4.1.
[[nodiscard]] CycleRegime cycle_regime(const SlipFunctions& w);

/// Stick–slip: S P S N, beginning with the stick phase after θ_P. Separation: from the first
/// instant of contact, the separated phase last. None for a point that is stuck or open throughout.
[[nodiscard]] CyclePhases cycle_phases(const SlipFunctions& w, CycleRegime regime);

}  // namespace microslip::contact
