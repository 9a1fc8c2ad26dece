/// @file
/// One tangential direction, a block of points through all instants of the period (theory sections
/// 8, 23):
///
///   s_i = clip(s_{i−1}; w_i, W_i),   f_i = k_i (u_i − s_i)                                    (1)
///   r_{i−1} ≤ 0 < r_i:   s_{i−1} is u where r, interpolated, vanishes                         (2)
///
/// r > 0 tells contact, g = μn/k is the half-width of the slider's band, [w, W] = [u − g, u + g].
/// On smooth surfaces the slider is taken along where u − g or u + g turns between two instants as
/// well, and (2) is by four instants: between two of them u and r are cubics whose slopes are those
/// of their neighbours, so that what turns and lands depends on the motion without a jump. On
/// others both are by two instants. Two periods from the virgin slider s = 0 give the steady cycle,
/// the second is kept. Arrays are [instant][point] with block_size points.
///
/// Compiled for several instruction sets; equal input gives equal bits on a machine.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "contact/lanes/block_size.hpp"

namespace microslip::contact::sampled {

/// What happens at one instant, as in ContactState; in arrays as numbers, like everything in lanes.
/// `turned`: sticks, after a slip that ended since the instant before.
enum class InstantState : std::int8_t {
  stick,
  positive_slip,
  negative_slip,
  separated,
  slip,
  turned
};
[[nodiscard]] constexpr InstantState instant_state(double value) {
  return static_cast<InstantState>(static_cast<std::int8_t>(value));
}

/// Borrowed arrays, n × block_size; n_instants of them.
struct LineArrays {
  std::size_t n_instants = 0;
  const double* u = nullptr;           ///< u [m]
  const double* closeness = nullptr;   ///< r: in contact where > 0, any unit
  const double* low = nullptr;         ///< w [m]
  const double* high = nullptr;        ///< W [m]
  const double* half_width = nullptr;  ///< g [m], 0 where separated
  /// Which end turned since the instant before and is in w or W, the other being of no matter: 0
  /// none, 1 w, 2 W, 3 first w then W, 4 first W then w; null: none at any,
  /// and (2) by two instants.
  const double* turns = nullptr;
  /// u where contact closed since the instant before, the least number where it did not;
  /// with `turns`.
  const double* landed = nullptr;
  double* slider = nullptr;  ///< s [m], written
  double* state = nullptr;   ///< InstantState, written
};

/// Constants of smooth surfaces, block_size numbers each.
struct SmoothArrays {
  const double* rest_load = nullptr;             ///< n₀'
  const double* normal_stiffness = nullptr;      ///< k_v
  const double* compliant_friction = nullptr;    ///< μ/k_u, 0 without friction
  const double* tangential_stiffness = nullptr;  ///< k_u, 0 without friction
};

/// What turning_band() writes, as in LineArrays.
struct TurningBand {
  double* low = nullptr;
  double* high = nullptr;
  double* turns = nullptr;
  double* landed = nullptr;
};

struct LineKernels {
  /// basis [n][rows], coefficients [rows][block] → values [n][block].
  void (*synthesize)(std::size_t n, std::size_t rows, const double* basis,
                     const double* coefficients, double* values);
  /// basis [n][stride], values [n][block] → sums [rows][block] of the first `rows` functions.
  void (*analyze)(std::size_t n, std::size_t rows, std::size_t stride, const double* basis,
                  const double* values, double* sums);
  /// v → r = n₀' + k_v v, n = max(r, 0), g = (μ/k_u) n.
  void (*load)(std::size_t n, const SmoothArrays& constants, const double* v, double* closeness,
               double* normal, double* half_width);
  /// u, r, g → w, W, which of them turn, and where points close if any does, of smooth surfaces.
  void (*turning_band)(std::size_t n, const SmoothArrays& constants, const double* u,
                       const double* closeness, const double* half_width, const TurningBand& band,
                       bool touches);
  /// (1), (2). @param touches  whether a point of the block both parts and closes.
  void (*march)(const LineArrays& arrays, bool touches);
  /// f = k_u (u − s).
  void (*friction)(std::size_t n, const SmoothArrays& constants, const double* u,
                   const double* slider, double* friction);
  /// Smallest and largest of each point over the instants.
  void (*range)(std::size_t n, const double* values, double* least, double* most);
};

/// The fastest kernels this machine can run.
[[nodiscard]] const LineKernels& line_kernels();
/// All that it can run, the plain ones first.
[[nodiscard]] std::vector<const LineKernels*> runnable_line_kernels();

}  // namespace microslip::contact::sampled
