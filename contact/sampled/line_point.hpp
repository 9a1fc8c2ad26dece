/// @file
/// Derivatives of the sampled force of one point along one direction, those of the sums over
/// instants (theory sections 6, 8):
///
///   stick  df_i = k_i (du_i − ds) + k_i' dv_i (u_i − s),  slip  df_i = ± d(μ n)_i,  apart  0   (1)
///   ds  after slip at i*         du ∓ dg  there
///       after touch-down         (1−x) du_{i−1} + x du_i + (u_i − u_{i−1}) dx,   n = 0 at i−1+x
///       virgin                   0                                                             (2)
///
/// so that ∂f̂/∂û = [products of moments of weights] + Σ_stick phases a ⊗ b,
/// a_k = −Σ_phase k_i T_k(θ_i), b of (2).
///
/// On smooth surfaces i* lies between instants, du there is that of the polynomial through its
/// neighbours, and the sums are mended at kinks (kinks.hpp);
/// their derivatives are complete but for parts of second order.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "contact/lanes/product_kernels.hpp"
#include "contact/sampled/instants.hpp"
#include "contact/sampled/kinks.hpp"
#include "contact/sampled/runs.hpp"

namespace microslip::contact::sampled {

/// What the instants of a point with any surface answer: filled where the surface is asked.
struct InstantSlopes {
  double stiffness = 0.0;              ///< k [N/m³]
  double stiffness_by_approach = 0.0;  ///< dk/dv
  double limit_by_approach = 0.0;      ///< d(μn)/dv
  double limit_by_rate = 0.0;          ///< d(μn)/dσ
  double width_by_approach = 0.0;      ///< dg/dv
  double width_by_rate = 0.0;          ///< dg/dσ
  double load_by_approach = 0.0;       ///< dn/dv
  double rate = 0.0;                   ///< u' [m]; σ = ω|u'|
};

class LineDerivatives {
 public:
  void reset(const Instants& instants);
  void smooth(const SmoothPoint& point, const std::vector<Run>& runs, const Kinks& kinks,
              const LineColumns& columns);
  /// @param slopes  n.   @param closeness_by_approach  dr/dv.
  void any_surface(const std::vector<InstantSlopes>& slopes, double closeness_by_approach,
                   double frequency, const std::vector<Run>& runs, const LineColumns& columns);
  /// After that, what mend() takes off. @param kinks  of the load of a smooth surface.
  void mend_load(const Kinks& kinks, double normal_stiffness);

  /// ∂f̂_k/∂û_l and ∂f̂_k/∂v̂_l in split order, without the norm of row k [N/m³];
  /// rows k lie row_stride() apart, with at least eight readable numbers behind the last.
  [[nodiscard]] const double* by_u() const { return by_u_.sum.data(); }
  [[nodiscard]] const double* by_v() const { return by_v_.sum.data(); }
  [[nodiscard]] std::size_t row_stride() const { return size_.stride; }
  /// Moments of dn/dv, those of Instants.
  [[nodiscard]] const double* normal_moments() const { return normal_.data(); }
  /// ∂f̂_k/∂ω, likewise; of any_surface() alone.
  [[nodiscard]] const double* by_frequency() const { return by_frequency_.data(); }

 private:
  struct Anchor;
  /// A matrix as a sum of a bᵀ, which waits until all of them are known: added one at a time most
  /// of the work would be to read and write the matrix.
  struct OuterSum {
    void clear() { n = 0; }
    /// @param a, b  of `size`: numbers as many as its rows and columns.
    void push(const ProductSizes& size, double factor, const std::vector<double>& a,
              const std::vector<double>& b);
    void add_up(const ProductSizes& size);

    std::vector<double> left, right;  // n × phi_stride, n × stride
    std::vector<double> sum;
    std::size_t n = 0;
  };
  void clear();
  void sum_part(const Run& run);
  void add_outer(const std::vector<double>& a, const std::vector<double>& b, double factor_u,
                 double factor_v);
  void add_anchor(const Anchor& anchor, const std::vector<double>& a);
  void hold_part();
  void add_stuck(const Run& run, const LineColumns& columns);
  void add_kinks(std::span<const Kink> kinks, const LineColumns& columns);
  void add_kink(const Kink& kink, double by_u, double by_v, bool moves);
  void add_slip(const Kink& kink, const LineColumns& columns);
  void add_contact(const Kink& kink);
  void sum_around(std::size_t now, const std::array<double, 4>& weights);
  void at_kink(const Kink& kink, double factor);
  void sum_up(double frequency);
  [[nodiscard]] Anchor landing(std::size_t before, std::size_t now, double closeness_by_approach,
                               const LineColumns& columns) const;
  [[nodiscard]] Anchor smooth_landing(std::size_t now, double normal_stiffness,
                                      const LineColumns& columns) const;
  [[nodiscard]] Anchor pushed(std::size_t now, const LineColumns& columns) const;
  [[nodiscard]] std::size_t before(std::size_t now) const;
  [[nodiscard]] std::size_t last_push(const LineColumns& columns) const;

  const Instants* instants_ = nullptr;
  std::size_t n_rows_ = 0;
  ProductSizes size_;
  OuterSum by_u_;
  OuterSum by_v_;
  std::vector<double> by_frequency_;
  std::vector<double> stick_;   // moments of k in stick
  std::vector<double> limit_;   // of ∂f/∂v
  std::vector<double> rate_;    // of ∂f/∂u'
  std::vector<double> normal_;  // of dn/dv
  std::vector<double> part_;
  std::vector<double> phase_;  // a
  std::vector<double> b_;
  std::vector<double> moved_;
  std::vector<double> row_;
  SmoothPoint point_;
  Products products_;
};

}  // namespace microslip::contact::sampled
