/// @file
/// Integrals over parts of a period: Gauss–Legendre panels, eight nodes each, as many as the
/// harmonics and the curvature of the surface law ask for.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <Eigen/Core>

#include "contact/plane/planar_motion.hpp"
#include "contact/trigonometric_basis.hpp"

namespace microslip::contact {

inline constexpr int n_gauss = 8;

/// On [−1, 1], with the shares of the highest Legendre polynomials, degree 7 and 6: one of them may
/// vanish by symmetry.
struct GaussNodes {
  std::array<double, n_gauss> node{};
  std::array<double, n_gauss> weight{};
  std::array<double, n_gauss> top{};
  std::array<double, n_gauss> second{};
};
[[nodiscard]] const GaussNodes& gauss_nodes();

/// One panel; visits its nodes if the law is resolved there, else its halves.
template <typename Visit>
void visit_panel(const PlanarMotion& motion, double begin, double end, int depth,
                 const Visit& visit) {
  const GaussNodes& rule = gauss_nodes();
  std::array<PlanarInstant, n_gauss> instant;
  const double half = 0.5 * (end - begin);
  Eigen::Vector3d top = Eigen::Vector3d::Zero();  // of load and stiffness ratios
  Eigen::Vector3d below = Eigen::Vector3d::Zero();
  double size = 0.0;
  for (std::size_t i = 0; i < instant.size(); ++i) {
    instant[i] = motion.at(0.5 * (begin + end) + half * rule.node[i]);
    const SurfaceState& y = instant[i].surface;
    const Eigen::Vector3d value(y.load, y.stiffness_ratio, y.second_stiffness_ratio);
    top += rule.top[i] * value;
    below += rule.second[i] * value;
    size = std::max(size, y.load);
  }
  // The rule is exact to degree 15: what is left out is about the square of these terms.
  constexpr double resolved = 1e-7;
  const bool rough = !motion.law().is_smooth();
  const Eigen::Vector3d left = top.cwiseAbs().cwiseMax(below.cwiseAbs());
  if (rough && depth > 0 && (left[0] > resolved * size || left.tail<2>().maxCoeff() > resolved)) {
    visit_panel(motion, begin, begin + half, depth - 1, visit);
    visit_panel(motion, begin + half, end, depth - 1, visit);
    return;
  }
  for (std::size_t i = 0; i < instant.size(); ++i) visit(instant[i], half * rule.weight[i]);
}

/// Calls visit(instant, weight) at the nodes of [begin, end], for products of the motion with
/// harmonics up to `highest`.
template <typename Visit>
void visit_nodes(const PlanarMotion& motion, double begin, double end, int highest,
                 const Visit& visit) {
  // A wave of k oscillations per 2π over a panel of length h errs by 2e-18 (kh/2)¹⁶.
  const double longest = 3.0 / (motion.n_harmonics() + highest);
  const int n = static_cast<int>(std::ceil((end - begin) / longest));
  constexpr int deepest = 12;
  for (int i = 0; i < n; ++i) {
    const double from = begin + (end - begin) * i / n;
    const double to = begin + (end - begin) * (i + 1) / n;
    visit_panel(motion, from, to, deepest, visit);
  }
}

}  // namespace microslip::contact
