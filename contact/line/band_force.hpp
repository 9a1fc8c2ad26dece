/// @file
/// Fourier coefficients of the forces of a steady cycle in its band (band_walk.hpp), their
/// derivatives, and the work of friction.
///
///   stick  f = k_u g (u − s),      slip  f = ±μ n,      g_0 = 1/2π, else 1/π
///   f_i = g_i ∫ f b_i dθ,   ∂f_i = g_i ∫ ∂f b_i dθ
///
/// with b_i the functions 1, sin θ, cos θ, sin 2θ, …; f is continuous, ends of pieces bring
/// nothing. The derivative of s is that of the instant θ_e at which the slider was left (theory
/// section 6):
///
///   after P, N     ∂s = ∂u ∓ ∂r at θ_e, an extremum of w
///   where u' = 0   ∂s = ∂u ∓ (r_v ∂v + r_v v' ∂θ_e),     ∂θ_e = −∂u'/u''     (the kink of |u'|)
///   touch-down     ∂s = ∂u + u' ∂θ_e,                    ∂θ_e = −∂v/v'
///   virgin         ∂s = −∂u₀ (u is counted without its mean)
///
/// Panels of band_quadrature.hpp, halved until the highest terms are resolved.
///
/// Source: theory sections 5, 6, 7, 10, 11.
#pragma once

#include <Eigen/Core>

#include "contact/line/band_quadrature.hpp"
#include "contact/line/band_walk.hpp"
#include "contact/numerics/trigonometric_moments.hpp"
#include "contact/point/point_method.hpp"

namespace microslip::contact {

/// Over one period, in contact.
struct BandWork {
  double dissipated_energy = 0.0;  ///< ∮ μ n |ds| [J/m²]
  double slip_distance = 0.0;      ///< ∮ |ds| [m]
  double normal_slip = 0.0;        ///< ∮ n |ds| [Pa·m]
};
[[nodiscard]] BandWork band_work(SliderBand& band, const BandCycle& cycle);

/// f_p and n; f_r is 0. @param n_harmonics  of the forces, ≥ 0.
[[nodiscard]] Harmonics band_force(SliderBand& band, const BandCycle& cycle, int n_harmonics);

/// `regime` and `period` of the result.
void set_states(const BandCycle& cycle, PointTraction& result);

/// Force with its derivatives; keeps its storage.
class BandTraction {
 public:
  /// As many harmonics as the motion; `result` is written whole.
  void set(SliderBand& band, const BandCycle& cycle, PointTraction& result);

 private:
  /// Weighted sums over the nodes; one row each. Slip under a constant coefficient has the first
  /// four alone.
  enum Sum : Eigen::Index {
    friction,
    load,
    load_by_v,
    by_v,          // ∂f/∂v
    by_u,          // ∂f/∂u
    by_velocity,   // ∂f/∂u'
    by_frequency,  // ∂f/∂ω
    n_sums = 8     // in two vectors of four
  };
  using Sums = Eigen::Matrix<double, n_sums, Eigen::Dynamic>;

  /// @param panel  of the piece; what it does not have stays as it is.
  void weigh(const SliderBand& band, const BandPiece& piece, const BandPanelNodes& panel);
  void add_piece(SliderBand& band, const BandPiece& piece);
  void add_memory(SliderBand& band, const BandPiece& piece);
  void write(PointTraction& result);

  Eigen::Matrix<double, n_band_nodes, n_sums> weighted_;
  Sums piece_;  // with the functions of the basis up to harmonic 2H
  Sums sums_;
  Eigen::VectorXd of_one_;
  Eigen::VectorXd basis_rate_;
  Eigen::VectorXd virgin_;  // ∂f/∂u₀
  Eigen::VectorXd frequency_memory_;
  Eigen::MatrixXd memory_by_u_, memory_by_v_;  // ∂f by way of s
  TrigonometricMoments moments_;
};

}  // namespace microslip::contact
