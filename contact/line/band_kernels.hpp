/// @file
/// Inner loops over the twelve nodes of a panel or cell of a band (slider_band.hpp), side by side:
///
///   motion   u, u', u'', v, v' and the functions of the basis at the phases m + x, from sin m and
///            cos m:  sin(m + x) = sin m cos x + cos m sin x, multiples by recurrence
///   layer    u' at the offsets x from an anchor a by (1) of band_layers.hpp, from sin a and cos a
///   sums     S_kj += Σ_i b_ki w_ji
///
/// |x| ≤ 1.3 rad, where series of sin and cos to x²⁰ are right to rounding. Compiled for the plain
/// instruction set and for AVX2 with FMA; the machine decides at run time. The order of summation
/// is fixed on a machine: equal input gives equal bits.
#pragma once

#include <array>
#include <vector>

namespace microslip::contact {

inline constexpr int n_band_nodes = 12;
inline constexpr double longest_band_arc = 1.3;  ///< |x| at most [rad]

/// Sine and cosine of one phase.
struct SineAndCosine {
  double sine = 0.0;
  double cosine = 1.0;
};

/// Coefficients of u and v: mean, sin, cos, sin 2, …, n_harmonics of each.
struct BandSeries {
  const double* u = nullptr;
  const double* v = nullptr;
  int n_harmonics = 0;
};

using BandValues = std::array<double, n_band_nodes>;

/// At the nodes [m]; the mean of u is left out.
struct BandMotion {
  BandValues position, velocity, acceleration, approach, approach_rate;
};

struct BandKernels {
  /// @param x        [n_band_nodes].
  /// @param n_basis  harmonics of the basis, at least those of the series; 0: none.
  /// @param basis    → [2 n_basis + 1][n_band_nodes].
  void (*motion)(const BandSeries& series, const SineAndCosine& middle, const double* x,
                 int n_basis, double* basis, BandMotion& now);
  /// @param rate  coefficients of u', as those of u.
  void (*layer)(const double* rate, int n_harmonics, const SineAndCosine& anchor,
                double velocity_there, const double* x, double* velocity);
  /// basis [n][n_band_nodes], weights [4 m][n_band_nodes] → sums [n at `stride`][4 m].
  void (*sums)(int n, int m, const double* basis, const double* weights, int stride, double* sums);
};

/// The fastest kernels this machine can run.
[[nodiscard]] const BandKernels& band_kernels();
/// All kernels this machine can run, the plain ones first, the fastest last.
[[nodiscard]] std::vector<const BandKernels*> runnable_band_kernels();

}  // namespace microslip::contact
