/// @file
/// A contact point with one tangential direction, any surface law, sampled in time (AFT):
///
///   f_i = g_i (2π/M) Σ_j f_j b_i(θ_j),   f_j = k_u g_p (u_j − s_j),  ±μ n in slip,  0 where separated   (1)
///
/// with g_i = 1/2π for the mean, else 1/π, b_i the functions 1, sin θ, cos θ, sin 2θ, … and the slider of
/// sampled_slider.hpp; n likewise. The Jacobian is the exact derivative of (1), samples that change their
/// state apart, and so is ∂f/∂ω where friction depends on the rate. w is ignored and f_r = 0.
///
/// Accuracy: O(1/M²); with M = 512 about 1e-5 to 1e-4 of k_u |u| + μ (|n₀| + k_v |v|). Exact up to
/// aliasing where the point sticks in contact throughout.
///
/// Source: theory sections 8, 10, 11.
#pragma once

#include "contact/point/point_law.hpp"
#include "contact/surface/surface_law.hpp"

namespace microslip::contact {

class SampledLaw final : public PointLaw {
 public:
  static constexpr int default_samples = 512;

  /// @param n_samples  M ≥ 8 per period.
  /// @throws std::invalid_argument  fewer samples.
  explicit SampledLaw(const SurfaceLaw& law, int n_samples = default_samples);

  /// @throws std::invalid_argument  4 H ≥ M: products of the highest harmonics would alias.
  void traction(const Harmonics& motion, double frequency, PointTraction& result) const override;
  /// Segments, work and slip are those between the samples to O(1/M²).
  /// @throws std::invalid_argument  4 H ≥ M, or 2 n_harmonics ≥ M.
  [[nodiscard]] PointHistory history(const Harmonics& motion, double frequency,
                                     const Eigen::VectorXd& phases, int n_harmonics) const override;
  [[nodiscard]] Eigen::Vector3d stuck_stiffness() const override;
  [[nodiscard]] double load_at_rest() const override;
  [[nodiscard]] std::optional<LinearRange> linear_range() const override;

 private:
  SurfaceLaw law_;
  int n_samples_;
};

}  // namespace microslip::contact
