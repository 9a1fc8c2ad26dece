/// @file
/// Derivatives of the sampled force of one point along one direction, exactly those of the sums over instants
/// (theory sections 6, 8):
///
///   stick   df_i = k_i (du_i − ds) + k_i' dv_i (u_i − s),   slip   df_i = ± d(μ n)_i,   apart   0       (1)
///   ds  after slip at i*         du ∓ dg  there
///       after touch-down         (1−x) du_{i−1} + x du_i + (u_i − u_{i−1}) dx,   n = 0 at i−1+x
///       virgin                   0                                                                    (2)
///
/// so that ∂f̂/∂û = [products of moments of weights] + Σ_stick phases a ⊗ b, a_k = −Σ_phase k_i T_k(θ_i), b of (2).
#pragma once

#include <cstddef>
#include <vector>

#include "contact/point/cycle_segments.hpp"
#include "contact/point/period_states.hpp"
#include "contact/sampled/instants.hpp"
#include "contact/sampled/line_kernels.hpp"

namespace microslip::contact::sampled {

/// Instants of the same state; goes on at 0 after the last. @param begin in [0, n).
struct Run {
  InstantState state = InstantState::stick;
  std::size_t begin = 0;
  std::size_t length = 0;
};

/// Of one point, in order of time, neighbours differ.
/// @param state  n numbers, `stride` apart.   @param runs  written whole.
void find_runs(const double* state, std::size_t n, std::size_t stride, std::vector<Run>& runs);

/// What a step control and a report want to know.
[[nodiscard]] CycleStates cycle_states(const std::vector<Run>& runs, std::size_t n);
[[nodiscard]] std::vector<CycleSegment> cycle_segments(const std::vector<Run>& runs, std::size_t n);

/// The march of one point, columns of a block.
struct LineColumns {
  const double* u = nullptr;
  const double* closeness = nullptr;
  const double* half_width = nullptr;
  const double* slider = nullptr;
};

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

/// Constants of smooth surfaces; k_u = 0 and μ = 0 both where there is no friction.
struct SmoothPoint {
  double tangential_stiffness = 0.0;
  double normal_stiffness = 0.0;
  double friction_coefficient = 0.0;
};

class LineDerivatives {
 public:
  void reset(const Instants& instants);
  void smooth(const SmoothPoint& point, const std::vector<Run>& runs, const LineColumns& columns);
  /// @param slopes  n.   @param closeness_by_approach  dr/dv.
  void any_surface(const std::vector<InstantSlopes>& slopes, double closeness_by_approach,
                   double frequency, const std::vector<Run>& runs, const LineColumns& columns);

  /// ∂f̂_k/∂û_l and ∂f̂_k/∂v̂_l in split order, without the norm of row k [N/m³].
  [[nodiscard]] const double* by_u(std::size_t k) const { return by_u_.data() + k * n_rows_; }
  [[nodiscard]] const double* by_v(std::size_t k) const { return by_v_.data() + k * n_rows_; }
  /// Moments of dn/dv, those of Instants.
  [[nodiscard]] const double* normal_moments() const { return normal_.data(); }
  /// ∂f̂_k/∂ω, likewise; of any_surface() alone.
  [[nodiscard]] const double* by_frequency() const { return by_frequency_.data(); }

 private:
  struct Anchor;
  void clear();
  void add_anchor(const Anchor& anchor, const std::vector<double>& a);
  void add_weights(double frequency);
  [[nodiscard]] Anchor landing(std::size_t before, std::size_t now, double closeness_by_approach,
                               const LineColumns& columns) const;
  [[nodiscard]] std::size_t last_push(const LineColumns& columns) const;

  const Instants* instants_ = nullptr;
  std::size_t n_rows_ = 0;
  std::vector<double> by_u_;
  std::vector<double> by_v_;
  std::vector<double> by_frequency_;
  std::vector<double> stick_;   // moments of k in stick
  std::vector<double> limit_;   // of ∂f/∂v
  std::vector<double> rate_;    // of ∂f/∂u'
  std::vector<double> normal_;  // of dn/dv
  std::vector<double> part_;
  std::vector<double> phase_;  // a
  std::vector<double> b_u_;
  std::vector<double> b_v_;
  std::vector<double> row_;
  Products products_;
};

}  // namespace microslip::contact::sampled
