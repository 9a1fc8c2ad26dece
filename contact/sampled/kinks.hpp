/// @file
/// Kinks of the sampled force of a point with a smooth surface. The sum over instants, h = 2π/n
/// apart, errs where the slope of a signal jumps by D between two of them (Euler and Maclaurin; x
/// from the one before, D per instant):
///
///   h Σ f_i T(θ_i) = ∮ f T dθ + Σ_kinks h [ D x (1−x)/2 − φ D'/12 ] T(θ_x) + O(h³)             (1)
///
/// D by the two instants, so that D x (1−x) is a smooth function of them however small the kink; D'
/// by the slopes of splines (step_spline.hpp), φ ≤ 1 the instants after which that slope would
/// vanish: a kink that has just begun has another one behind it, not an instant.
///
/// Slip begins where u − g or u + g meets the slider, contact closes and opens where r vanishes;
/// where slip ends there is no kink. Taking (1) off the two samples around each leaves a force
/// whose error falls with n³, and which does not jump where a kink passes an instant.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "contact/sampled/runs.hpp"

namespace microslip::contact::sampled {

/// Constants of smooth surfaces; k_u = 0 and μ = 0 both where there is no friction.
struct SmoothPoint {
  double tangential_stiffness = 0.0;
  double normal_stiffness = 0.0;
  double friction_coefficient = 0.0;

  /// g/n.
  [[nodiscard]] double compliance() const {
    return tangential_stiffness > 0.0 ? friction_coefficient / tangential_stiffness : 0.0;
  }
};

/// The march of one point, columns of a block (lanes/line_kernels.hpp).
struct LineColumns {
  const double* u = nullptr;
  const double* closeness = nullptr;
  const double* low = nullptr;
  const double* high = nullptr;
  const double* turns = nullptr;  ///< null: of any surface
  const double* slider = nullptr;
};

/// u + side g at the four instants around the step that ends at `now`, extended by r < 0.
/// @param side  −1 w, 1 W.
[[nodiscard]] std::array<double, 4> end_of_band(const SmoothPoint& point,
                                                const LineColumns& columns, double side,
                                                std::size_t now, std::size_t n);

struct Kink {
  enum class Kind : std::int8_t { none, slips, closes, opens };
  Kind kind = Kind::none;
  std::size_t before = 0;  ///< instants around it
  std::size_t now = 0;
  double share = 0.0;     ///< x in [0, 1]
  double friction = 0.0;  ///< [ ] of (1) for f_p [N/m²]
  double load = 0.0;      ///< for n
  /// Of the limit μn along which friction leaves or meets the kink, 1 or −1; 0: it sticks, closing.
  double side = 0.0;
  double force = 0.0;        ///< of `closes`: f_p at the instant behind
  double stick_slope = 0.0;  ///< of `closes`: of u at the kink, by instants
  double stick_bend = 0.0;
  /// Of u ∓ g where slip begins, of r elsewhere: over the step, by instants at the kink.
  double rise = 0.0;
  double slope = 0.0;
  double bend = 0.0;
  double damping = 0.0;  ///< φ

  /// x (1−x)/2 and its derivative.
  [[nodiscard]] double weight() const { return 0.5 * share * (1.0 - share); }
  [[nodiscard]] double weight_slope() const { return 0.5 - share; }
  /// Of φ D' by D': φ falls with it.
  [[nodiscard]] double late() const { return damping < 1.0 ? 2.0 * damping : damping; }
};

/// In the step in which a run ends: what sticks and opens slips in between.
struct RunEnd {
  Kink slip;
  Kink contact;
};

/// @param n  instants.   @param ends  one of each run, none of a single one; written whole.
void find_kinks(const SmoothPoint& point, const std::vector<Run>& runs, const LineColumns& columns,
                std::size_t n, std::vector<RunEnd>& ends);

/// Takes (1) off the samples. @param friction, normal  columns of a block.
void mend(const std::vector<RunEnd>& ends, double* friction, double* normal);

}  // namespace microslip::contact::sampled
