/// @file
/// The slider of a sampled cycle: two passes through the samples, the second of which is the steady
/// cycle, and what its position remembers.
///
///   s_j = clip(s_{j−1}; u_j − g_j, u_j + g_j),   u_j where separated                          (1)
///
/// Where contact begins between j − 1 and j, at the share x of the step, the slider starts from
///
///   s = (1 − x) u_{j−1} + x u_j,   x = (v_touch − v_{j−1})/(v_j − v_{j−1})                    (2)
///
/// before the clip of step j; without this the error would be O(1/M), and its derivative wrong. At an
/// instant where u turns (sampled_motion.hpp) there is a clip between. The period map is idempotent
/// (theory section 4.6), so two passes from a virgin slider are enough.
///
/// The position after (1) or (2) depends on the motion at one step alone: that step is the memory, and
/// its derivative is formed only where the slider rests on it.
///
/// Source: theory sections 4.6, 8.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "contact/closed_form/friction_cycle.hpp"
#include "tests/support/sampled/sampled_motion.hpp"

namespace microslip::contact {

/// What put the slider where it is, at the step that ends at sample `step`.
struct SliderMemory {
  enum class Kind : std::uint8_t {
    virgin,
    positive_slip,
    negative_slip,
    separated,
    touch_down,
    positive_turn,  ///< slip at the instant where u turns
    negative_turn,
  };
  Kind kind = Kind::virgin;
  int step = 0;

  bool operator==(const SliderMemory&) const = default;
};

struct SliderSample {
  ContactState state = ContactState::stick;
  double slider = 0.0;  ///< s_j [m]
  SliderMemory memory;
};

/// ∂s/∂ of the coefficients of u and v [-], each 2H + 1, and of ω [m·s].
struct SliderDerivative {
  Eigen::VectorXd by_u;
  Eigen::VectorXd by_v;
  double by_frequency = 0.0;
};

class SampledSlider {
 public:
  /// Both passes. @param motion  borrowed until the next call.
  void march(const SampledMotion& motion);

  [[nodiscard]] const SliderSample& operator[](int j) const {
    return samples_[static_cast<std::size_t>(j)];
  }
  [[nodiscard]] CycleRegime regime() const;
  /// @param n_harmonics  H of the motion.   @param result  written whole.
  void differentiate(const SliderMemory& memory, const SampleGrid& grid, int n_harmonics,
                     SliderDerivative& result) const;

 private:
  void pass();
  SliderSample step(SliderSample now, int j) const;
  void differentiate_clip(double sign, int j, const SampleGrid& grid, int n_harmonics,
                          SliderDerivative& result) const;
  void differentiate_touch(int j, const SampleGrid& grid, SliderDerivative& result) const;
  void differentiate_turn(double sign, int j, const SampleGrid& grid, int n_harmonics,
                          SliderDerivative& result) const;

  const SampledMotion* motion_ = nullptr;
  std::vector<SliderSample> samples_;
};

/// Derivative of the basis by θ, of which `basis` is a column; size 2 n_harmonics + 1.
void set_basis_rate(const double* basis, int n_harmonics, Eigen::VectorXd& rate);

/// Pushes the slider into the band of one instant; the memories are those of a push up or down.
[[nodiscard]] SliderSample clipped(SliderSample now, const ContactSample& band,
                                   SliderMemory positive, SliderMemory negative);

}  // namespace microslip::contact
