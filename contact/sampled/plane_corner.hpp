/// @file
/// Where a slider that two windows of the period push in turn comes to rest,
/// of one point in lanes (theory sections 9,
/// 23.1): on the edge of the ellipses of both, which march along the valley between them comes near
/// like 1/periods.
///
///   G_j(s) = max_θ near θ_j |W⁻¹ (x − s)| − 1 = 0,    j = 1, 2                                 (1)
///
/// by Newton's method from outside both. If it turns back there is no corner and the slider slips
/// for good. The maximum is that of the parabola through the highest instant and its neighbours,
///
///   δG = Σ_k c_k(x) δ|W_k⁻¹ (x_k − s)|,    c = [x (x−1)/2, 1 − x², x (x+1)/2]                  (2)
///
/// x from the highest instant, by which G errs in the fourth order of a step and (2) in the third.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "contact/lanes/plane_kernels.hpp"

namespace microslip::contact::sampled {

/// The ellipse of one instant against a slider.
struct CornerInstant {
  std::size_t instant = 0;
  double share = 0.0;              ///< c
  double length = 0.0;             ///< |W⁻¹ (x − s)|
  std::array<double, 2> pull{};    ///< W⁻¹ (x − s), of length one
  std::array<double, 2> normal{};  ///< −∂|W⁻¹ (x − s)|/∂s
};

struct CornerWindow {
  std::array<CornerInstant, 3> instants;
  double excess = 0.0;  ///< G
  std::array<double, 2> normal{};
};

struct PlaneCorner {
  std::array<double, 2> slider{};
  std::array<CornerWindow, 2> windows;
};

/// @param place     of the point in the block; in contact at all instants.
/// @param instants  at which slip ended.   @param slider  outside both ellipses or on their edges.
/// @return nothing where the windows have no corner, or none that is found.
[[nodiscard]] std::optional<PlaneCorner> meeting_corner(const PlaneArrays& arrays,
                                                        std::size_t place,
                                                        const std::array<std::size_t, 2>& instants,
                                                        const std::array<double, 2>& slider);

/// Whether a slider lies in the ellipses of all instants, rounding aside.
[[nodiscard]] bool rests_throughout(const PlaneArrays& arrays, std::size_t place,
                                    const std::array<double, 2>& slider);

/// The last instants of both stretches of slip of the recorded period;
/// nothing where there are not two.
[[nodiscard]] std::optional<std::array<std::size_t, 2>> two_ends_of_slip(const PlaneArrays& arrays,
                                                                         std::size_t place);

}  // namespace microslip::contact::sampled
