/// @file
/// Inner loops of the projection (sampled/projection.hpp):
///
///   spread    y[m][l] = Σ_s φ_s[m] J_s[l]           J Φ of one point, one row of its friction
///   product   C[a][j] += Σ_rows φ[row][a] y[row][j]
///
/// Compiled for several instruction sets; equal input gives equal bits on a machine.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace microslip::contact::sampled {

/// So many numbers behind the last column are read and written, never used.
inline constexpr std::size_t product_slack = 24;

/// Sizes of C += φᵀ y: rows of φ, y and C lie `phi_stride`, `stride` and `stride` numbers apart.
struct ProductSizes {
  std::size_t n_left = 0;     ///< a
  std::size_t n_columns = 0;  ///< j
  std::size_t phi_stride = 0;
  std::size_t stride = 0;  ///< ≥ n_columns + product_slack
};

struct ProductKernels {
  /// @param n_rows  l < n_rows; up to seven numbers more are read behind each row of J,
  ///                and written behind y.
  void (*spread)(std::size_t n_signals, std::size_t n_modes, std::size_t n_rows,
                 const std::array<const double*, 3>& J,
                 const std::array<std::vector<double>, 3>& phi, double* y);
  void (*product)(const ProductSizes& size, std::size_t n, const double* phi, const double* y,
                  double* sum);
};

/// The fastest this machine can run.
[[nodiscard]] const ProductKernels& product_kernels();

}  // namespace microslip::contact::sampled
