/// @file
/// Sum over the points of a patch of sampled forces and derivatives,
/// projected on the modes (theory section 13):
///
///   G^(k) = Σ w (φ_u f_p + φ_v n + φ_w f_r)^(k),   ∂G^(k)/∂q^(l) = Σ w Σ_st φ_s J_st,kl φ_tᵀ
///
/// Points are taken in blocks. Friction: J φ_t of each point, then one product with Φ per row k.
/// Load: its derivatives are known by 4H + 1 moments, one product of these with the pairs of modes.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "contact/lanes/product_kernels.hpp"
#include "contact/modal_force.hpp"
#include "contact/patch.hpp"
#include "contact/sampled/instants.hpp"

namespace microslip::contact::sampled {

/// ∂f̂/∂(û, v̂, ŵ) of one point in split order, rows without their norm.
struct PointDerivatives {
  /// n_rows × n_rows and at least eight readable numbers behind; [f_p, f_r][u, v, w].
  std::array<std::array<const double*, 3>, 2> friction{};
  std::size_t stride = 0;                       ///< from one row to the next, ≥ n_rows
  const double* normal_moments = nullptr;       ///< of dn/dv
  std::array<const double*, 2> by_frequency{};  ///< of f_p, f_r; null: 0
};

class Projection {
 public:
  /// @param of_motion, of_force  see LineBlock.
  /// @param rows  asked for, as of Harmonics, ascending.
  void start(const ModalShapes& shapes, const Instants& of_motion, const Instants& of_force,
             const std::vector<Eigen::Index>& rows);
  /// @param sums  of f_p, n and f_r or null: numbers `stride` apart, Σ_i f_i T_k.
  void add(Eigen::Index point, double weight, double reference_load,
           const std::array<const double*, 3>& sums, std::size_t stride,
           const PointDerivatives* derivatives);
  /// Takes in the sums of other points of the patch, started alike.
  void join(Projection& other);
  [[nodiscard]] ForceAndJacobian take();

 private:
  void flush();
  void spread(const PointDerivatives& derivatives);
  void add_friction(ForceAndJacobian& result) const;
  void add_normal(ForceAndJacobian& result) const;

  const ModalShapes* shapes_ = nullptr;
  const Instants* motion_ = nullptr;
  const Instants* force_ = nullptr;
  std::vector<Eigen::Index> rows_;
  std::vector<std::size_t> asked_;  // in split order, ascending
  bool all_ = true;
  std::size_t n_modes_ = 0;
  std::size_t n_directions_ = 1;  // of friction
  std::size_t n_waiting_ = 0;     // points
  ProductSizes force_size_, pair_size_, size_;
  std::size_t spread_block_ = 0;               // of numbers, from one row k to the next
  std::vector<double> phi_t_, phi_v_, pairs_;  // weighted
  std::array<std::vector<double>, 3> shape_;   // of one point, u, v, w
  std::vector<double> tangential_, normal_, by_frequency_;  // coefficients of the points waiting
  std::vector<double> moments_, spread_, compact_;
  std::vector<double> force_sum_, by_frequency_sum_, pair_sum_, sum_;
  bool any_by_frequency_ = false;
  bool any_derivative_ = false;
};

}  // namespace microslip::contact::sampled
