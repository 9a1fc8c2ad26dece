/// @file
/// A periodic motion and its surfaces at equally spaced instants: everything a sampled cycle needs that
/// does not depend on the slider.
///
///   θ_j = 2πj/M,   σ_j = ω |u'_j|,   half-width of the slider's band  g = μ n / (k_u g_p)          (1)
///
/// A friction coefficient that depends on σ gives g a kink where u turns. That instant is kept between
/// its neighbours a = u'_{j−1}, c = u'_j of opposite sign,
///
///   x = a/(a − c),   u_x = u_{j−1} + ½ Δθ x a,   v_x = (1 − x) v_{j−1} + x v_j,   σ_x = 0           (2)
///
/// without it the slider would be pushed too far or not far enough by O(1/M) where μ rises with σ.
///
/// Source: theory sections 8, 10.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "contact/harmonics.hpp"
#include "contact/surface/surface_law.hpp"

namespace microslip::contact {

/// A point at one instant. Stiffness is k_u g_p; without it there is no friction either.
struct ContactSample {
  double u = 0.0;
  double u_rate = 0.0;  ///< du/dθ
  double v = 0.0;
  double load = 0.0;  ///< n
  double load_by_v = 0.0;
  double friction_coefficient = 0.0;
  double friction_coefficient_by_rate = 0.0;
  double stiffness = 0.0;
  double stiffness_by_v = 0.0;
  double half_width = 0.0;  ///< g of (1) [m]; 0 where separated
  double half_width_by_v = 0.0;
  double half_width_by_rate = 0.0;  ///< ∂g/∂σ

  [[nodiscard]] bool is_open() const { return load <= 0.0; }
  [[nodiscard]] double limit() const { return friction_coefficient * load; }
};

/// (1) of one instant. @param u_rate  du/dθ [m].
[[nodiscard]] ContactSample contact_sample(const SurfaceLaw& law, double frequency, double u,
                                           double u_rate, double v);

/// Functions of the Fourier convention at the samples.
struct SampleGrid {
  int n_samples = 0;
  int n_harmonics = 0;
  Eigen::MatrixXd basis;  ///< (2 n_harmonics + 1) × n_samples, order of set_basis()
};

/// Kept for the next call of the same thread.
[[nodiscard]] const SampleGrid& sample_grid(int n_samples, int n_harmonics);

class SampledMotion {
 public:
  /// @param motion  columns u and v are read.   @param grid  at least the harmonics of the motion.
  void set(const SurfaceLaw& law, const Harmonics& motion, double frequency,
           const SampleGrid& grid);

  [[nodiscard]] int size() const { return static_cast<int>(samples_.size()); }
  [[nodiscard]] const ContactSample& operator[](int j) const {
    return samples_[static_cast<std::size_t>(j)];
  }
  [[nodiscard]] int before(int j) const { return j > 0 ? j - 1 : size() - 1; }
  [[nodiscard]] double step() const { return step_; }
  [[nodiscard]] double frequency() const { return frequency_; }

  /// The instant of (2) between j − 1 and j, or null.
  [[nodiscard]] const ContactSample* turn(int j) const;
  /// x of (2), given that there is one.
  [[nodiscard]] double turn_share(int j) const;
  /// Where between j − 1 and j the surfaces touch or part, as a share of the step, given that one of
  /// both is open and the other is not.
  [[nodiscard]] double touch_share(int j) const;

 private:
  void find_turns(const SurfaceLaw& law);

  std::vector<ContactSample> samples_;
  std::vector<ContactSample> turns_;
  std::vector<int> turn_of_;  // by sample; −1: none
  double step_ = 0.0;
  double frequency_ = 0.0;
  bool touches_at_kink_ = false;
  double touch_ = 0.0;  // approach at which contact begins
};

}  // namespace microslip::contact
