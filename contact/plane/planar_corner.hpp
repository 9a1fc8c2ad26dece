/// @file
/// Where a slider that two ellipses push in turn comes to rest.
///
/// Stuck throughout is possible for every slider in the intersection of the ellipses of all phases.
/// A slider outside is pushed in; where the boundaries of two windows of the period meet at an
/// acute angle it goes to and fro between them, by ever smaller steps, towards their corner:
///
///   G_i(s) = max_{θ near θ_i} |K (x − s)| − r = 0,    i = 1, 2                                 (1)
///
/// G is convex in s, so that Newton's method on (1), begun outside both, stays outside and
/// approaches the corner from one side. If it turns back there is no corner: the two ellipses have
/// no point in common, and the slider slips for good. ∇G = −K e with the direction e of the force.
///
/// Source: theory sections 4.2, 9 (common point of the discs).
#pragma once

#include <array>
#include <optional>

#include "contact/plane/planar_motion.hpp"

namespace microslip::contact {

/// One side of the corner: the phase at which its ellipse is felt most.
struct CornerSide {
  double phase = 0.0;
  double excess = 0.0;                                 ///< G / F₀
  Eigen::Vector2d force = Eigen::Vector2d::Zero();     ///< K (x − s) / F₀
  Eigen::Vector2d gradient = Eigen::Vector2d::Zero();  ///< ∇G by s / L₀
};

struct SliderCorner {
  Eigen::Vector2d slider = Eigen::Vector2d::Zero();  ///< / L₀
  std::array<CornerSide, 2> side;
};

/// @param phases  of the two windows, where slip ended.
/// @param slider  of the march, outside or on the edge of both.
/// @return nothing where the windows have no corner, or none that is found.
[[nodiscard]] std::optional<SliderCorner> meeting_corner(const PlanarMotion& motion,
                                                         const std::array<double, 2>& phases,
                                                         const Eigen::Vector2d& slider);

}  // namespace microslip::contact
