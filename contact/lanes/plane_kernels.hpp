/// @file
/// Two tangential directions, a block of points through all instants of the period (theory sections
/// 9, 23.1). With the half-widths W = diag(W_p, W_r) of the slider's ellipse around x = (u, w),
/// W_p = μ n/k_p:
///
///   η = W⁻¹ (x − s),   |η| ≤ 1,   f = μ n η;   slip: η = e, s = x − W e, s' ∥ e               (1)
///
/// Between two instants x and W are straight lines. A step ends in stick where |W₁⁻¹ (x₁ − s)| ≤ 1;
/// else slip begins at the part ξ of it where |η₀ + ξ (η₁ − η₀)| = 1, at once where it goes on,
/// and turns e by (2):
///
///   α' = e_⊥·d/c,   d = x' − (e_⊥·W' e) e_⊥,   c = e_⊥·W e_⊥,      e = e(α)                   (2)
///   tan ½∠(e₁, d) = tan ½∠(e₀, d)/P,   P = 1 + z + z²/2 + z³/6,   z = |d|/c over the step      (3)
///
/// (3) is (2) with d and c held, those of e half a step on; P is exp(z) to third order. Whatever
/// the step, e only comes nearer to d. With equal widths d and c do not depend on e.
///
/// Touch-down inside a step: s = x where r, interpolated, vanishes. Slip from there on is
/// self-similar: (λ + W₁) e = x₁ − s with λ ≥ 0 so that |e| = 1.
///
/// Arrays are [instant][point] with block_size points. Compiled for several instruction sets; equal
/// input gives equal bits on a machine.
#pragma once

#include <cstddef>
#include <vector>

#include "contact/lanes/block_size.hpp"

namespace microslip::contact::sampled {

/// Of |η|²: what rounding leaves of a slider that was pushed to the edge of its ellipse is no slip.
inline constexpr double slip_edge = 1.0 + 1e-12;

/// Of the state at instant 0: s_p, s_r, η_p, η_r, 1 where the point slips; [number][block].
inline constexpr std::size_t n_state_numbers = 5;

/// ∂α₁ of (3) by α₀, Δx_p, Δx_r, and W_p, W_r at onset and at the end of the step; ξ;
/// [number][block].
enum TurnNumber : std::size_t {
  by_angle,
  by_way_p,
  by_way_r,
  by_first_width_p,
  by_first_width_r,
  by_last_width_p,
  by_last_width_r,
  onset,
  n_turn_numbers
};

/// How slip of an instant began: in arrays as numbers.
enum class SlipEntry : int { goes_on, begins, touches_down };

/// Borrowed arrays, n × block_size; n_instants of them.
struct PlaneArrays {
  std::size_t n_instants = 0;
  const double* u = nullptr;          ///< [m]
  const double* w = nullptr;          ///< [m]
  const double* closeness = nullptr;  ///< r: in contact where > 0, any unit
  const double* width_p = nullptr;    ///< W_p [m]
  const double* width_r = nullptr;
  const double* inverse_p = nullptr;  ///< 1/W_p, 0 where it vanishes
  const double* inverse_r = nullptr;
  // Written by record() and linearise().
  double* slider_p = nullptr;  ///< s [m]
  double* slider_r = nullptr;
  double* pull_p = nullptr;  ///< η
  double* pull_r = nullptr;
  double* state = nullptr;  ///< InstantState
  double* entry = nullptr;  ///< SlipEntry, where the point slips
  double* turns =
      nullptr;  ///< [instant][TurnNumber][block], where the point slips; of linearise() alone
};

struct PlaneKernels {
  /// The state at instant 0 of a slider that stands at its s:
  /// taken back to the ellipse where it is beyond.
  void (*start)(const PlaneArrays& arrays, double* state);
  /// One period from instant 0 to instant 0; `state` becomes that at its end.
  /// @param slips  1 where a point slips at some instant, else 0.
  void (*march)(const PlaneArrays& arrays, bool equal_widths, double* state, double* slips);
  /// The same, written down.
  void (*record)(const PlaneArrays& arrays, bool equal_widths, double* state, double* slips);
  /// And with derivatives.
  void (*linearise)(const PlaneArrays& arrays, bool equal_widths, double* state, double* slips);
  /// x → 1/x, 0 for 0; n × block_size.
  void (*invert)(std::size_t n, const double* values, double* inverse);
};

/// The fastest kernels this machine can run.
[[nodiscard]] const PlaneKernels& plane_kernels();
/// All that it can run, the plain ones first.
[[nodiscard]] std::vector<const PlaneKernels*> runnable_plane_kernels();

}  // namespace microslip::contact::sampled
