/// @file
/// Dense products over one block of contact points, the inner loops of PatchForce. Arrays are
/// [row][point] with `block_points` points per row, of which the first n_points, a multiple of
/// `lane_points`, are read; points that are missing up to there are zero.
///
///   add_force          G_rm += Σ_points φ_m f_r                  modal force
///   add_products       C_eij += Σ_points φ_i ψ_j a_e             modal Jacobian, entry e
///   add_symmetric_products    the same for ψ = φ, only j ≤ i
///
/// Compiled for the plain instruction set and for AVX2 and AVX-512 with FMA; the machine decides at
/// run time. The order of summation is fixed on a machine: equal input gives equal bits.
#pragma once

#include <cstddef>
#include <vector>

namespace microslip::contact {

inline constexpr std::size_t block_points = 64;
inline constexpr std::size_t lane_points = 8;

struct BlockKernels {
  /// phi [n_modes][block], force [3][block] → sum [3][n_modes].
  void (*add_force)(std::size_t n_modes, std::size_t n_points, const double* phi,
                    const double* force, double* sum);
  /// phi, psi [n_modes][block], a [9][block] → sum [n_modes][n_modes][9].
  void (*add_products_9)(std::size_t n_modes, std::size_t n_points, const double* phi,
                         const double* psi, const double* a, double* sum);
  /// phi [n_modes][block], a [7][block] → sum [n_modes][n_modes][7], j ≤ i.
  void (*add_symmetric_products_7)(std::size_t n_modes, std::size_t n_points, const double* phi,
                                   const double* a, double* sum);
  /// phi [n_modes][block], a [6][block] → sum [n_modes][n_modes][6], j ≤ i.
  void (*add_symmetric_products_6)(std::size_t n_modes, std::size_t n_points, const double* phi,
                                   const double* a, double* sum);
};

/// The fastest kernels this machine can run.
[[nodiscard]] const BlockKernels& block_kernels();
/// All kernels this machine can run, the plain ones first, the fastest last.
[[nodiscard]] std::vector<const BlockKernels*> runnable_block_kernels();

}  // namespace microslip::contact
