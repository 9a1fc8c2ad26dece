/// @file
/// Inner loops of ∂G/∂q = Σ_i w_i Φ_iᵀ J_i Φ_i for points with any number of harmonics
/// (point_projection.hpp):
///
///   spread   y_ksl = Σ_t a_kslt φ_t         J_i Φ_i of one point, harmonic k of signal s by
///                                           harmonic l
///   add      C += Φᵀ Y                      of a block of points, for one k
///
/// Rows are padded: a row of φ with zeros to `phi_stride`, a row of y by `spare` numbers at least
/// that are written and never read. Compiled for the plain instruction set and for AVX2 and AVX-512
/// with FMA; the machine decides at run time. The order of summation is fixed on a machine:
/// equal input gives equal bits.
#pragma once

#include <cstddef>
#include <vector>

namespace microslip::contact {

/// Strides are multiples of this; so much is written beyond the end of a row of y.
inline constexpr std::size_t projection_lanes = 16;

/// Sizes of the arrays below.
struct ProjectionSizes {
  std::size_t n_modes = 0;
  std::size_t n_signals = 0;   ///< 2 or 3
  std::size_t n_rows = 0;      ///< harmonic rows asked for
  std::size_t phi_stride = 0;  ///< ≥ n_modes
  std::size_t stride = 0;      ///< ≥ n_rows · n_modes + projection_lanes
  std::size_t block = 0;       ///< doubles from one k of y to the next
};

struct ProjectionKernels {
  /// phi [n_signals][phi_stride], a [n_rows][n_signals][n_rows][n_signals] → y [n_rows at `block`]
  /// [n_signals at `stride`][n_rows · n_modes].
  void (*spread)(const ProjectionSizes& size, const double* phi, const double* a, double* y);
  /// phi [n][phi_stride], y [n][stride] → sum [n_modes][stride], n rows of points and signals.
  void (*add)(const ProjectionSizes& size, std::size_t n, const double* phi, const double* y,
              double* sum);
};

/// The fastest kernels this machine can run.
[[nodiscard]] const ProjectionKernels& projection_kernels();
/// All kernels this machine can run, the plain ones first, the fastest last.
[[nodiscard]] std::vector<const ProjectionKernels*> runnable_projection_kernels();

}  // namespace microslip::contact
