/// @file
/// Fourier sums of a sampled cycle and their derivatives ((1) of sampled_cycle.hpp).
#pragma once

#include "contact/numerics/trigonometric_moments.hpp"
#include "contact/point/point_law.hpp"
#include "tests/support/sampled/sampled_slider.hpp"

namespace microslip::contact {

/// Tangential force at a sample [Pa].
[[nodiscard]] double sampled_friction(const ContactSample& at, const SliderSample& slider);

/// Forces and Jacobian of a march; keeps its storage for the next one.
class SampledForce {
 public:
  /// @param has_friction  μ and k_u may differ from 0.
  /// f_p and n; f_r is 0. @param n_harmonics  of the forces; the grid has them.
  [[nodiscard]] Harmonics force(const SampledMotion& motion, const SampledSlider& slider,
                                const SampleGrid& grid, int n_harmonics);
  /// @param grid  with twice the harmonics H of the motion.   @param result  written whole.
  void traction(const SampledMotion& motion, const SampledSlider& slider, const SampleGrid& grid,
                int n_harmonics, PointTraction& result);

 private:
  enum Column : int { friction, normal, by_u, by_v, load_by_v, by_rate, by_frequency, n_columns };

  void set_weights(const SampledMotion& motion, const SampledSlider& slider);
  void set_springs(const SampledMotion& motion, int n_harmonics, PointTraction& result);
  void add_memories(const SampledMotion& motion, const SampledSlider& slider,
                    const SampleGrid& grid, int n_harmonics, PointTraction& result);
  void add_memory(const SampledSlider& slider, const SliderMemory& memory, const SampleGrid& grid,
                  int n_harmonics, double step, PointTraction& result);

  Eigen::MatrixXd weights_;  // n_samples × n_columns
  Eigen::MatrixXd sums_;     // (2 · 2H + 1) × n_columns, times the step
  Eigen::VectorXd stretch_;  // Σ stiffness · basis of one stick phase
  SliderDerivative derivative_;
  TrigonometricMoments stiffness_;
  TrigonometricMoments coupling_;
  TrigonometricMoments normal_;
  TrigonometricMoments rate_;
};

}  // namespace microslip::contact
