/// @file
/// Laws and motion of one point in extended precision, for surface_reference.cpp.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "support/surface_reference.hpp"

namespace microslip::test {

using Real = long double;
using contact::Harmonics;

struct Wave {
  std::vector<Real> sine, cosine;
  Real mean = 0.0L;

  Wave(const Harmonics& motion, Eigen::Index signal) {
    for (int h = 1; h <= motion.n_harmonics(); ++h) {
      sine.push_back(motion.rows()(2 * h - 1, signal));
      cosine.push_back(motion.rows()(2 * h, signal));
    }
    mean = motion.rows()(0, signal);
  }
  [[nodiscard]] std::array<Real, 3> at(Real x) const {  // y, y', y''
    std::array<Real, 3> y{mean, 0.0L, 0.0L};
    const Real s1 = std::sin(x);
    const Real c1 = std::cos(x);
    Real s = s1;
    Real c = c1;
    for (std::size_t i = 0; i < sine.size(); ++i) {
      const Real h = static_cast<Real>(i) + 1.0L;
      const Real value = sine[i] * s + cosine[i] * c;
      y[0] += value;
      y[1] += h * (sine[i] * c - cosine[i] * s);
      y[2] -= h * h * value;
      const Real next = s * c1 + c * s1;
      c = c * c1 - s * s1;
      s = next;
    }
    return y;
  }
};

struct Height {
  Real delta = 0.0L;  // δ
  Real share = 0.0L;  // h*
  Real reach = 0.0L;  // δ/h*
  Real reach_rate = 0.0L;
};

inline Height height_at(const ReferenceLaw& law, Real u) {
  if (law.heights == ReferenceHeights::none) {
    return u > 0.0L ? Height{u, 1.0L, u, 1.0L} : Height{};
  }
  if (law.heights == ReferenceHeights::cubic) {
    const Real R = law.height;
    const Real x = u / R;
    if (x <= 0.0L) return {};
    if (x >= 1.0L) return {u - R / 2.0L, 1.0L, u - R / 2.0L, 1.0L};
    const Real q = 3.0L - 2.0L * x;
    return {R * (x * x * x - x * x * x * x / 2.0L), x * x * q, R * x * (1.0L - x / 2.0L) / q,
            ((1.0L - x) * q + 2.0L * x * (1.0L - x / 2.0L)) / (q * q)};
  }
  const Real s = law.deviation;
  const Real z = (u - law.mean) / s;
  const Real phi = std::exp(-z * z / 2.0L) / std::sqrt(2.0L * std::numbers::pi_v<Real>);
  const Real Phi = std::erfc(-z / std::sqrt(2.0L)) / 2.0L;
  const Real J = z * Phi + phi;
  return {s * J, Phi, s * J / Phi, 1.0L - J * phi / (Phi * Phi)};
}

struct State {
  Real load = 0.0L, mu = 0.0L, ratio = 1.0L;  // n, μ, g
  Real reach = 0.0L, reach_rate = 0.0L;       // r, r'
};

class Point {
 public:
  Point(const ReferenceLaw& law, const Harmonics& motion, double frequency)
      : law_(law), u_(motion, 0), v_(motion, 1), frequency_(frequency) {
    slider_mean_ = u_.mean;
    u_.mean = 0.0L;
    const Real k_T = law.point.tangential_stiffness;
    gamma_u_ = static_cast<Real>(law.series.p) * k_T;
    gamma_v_ = static_cast<Real>(law.series.q) * static_cast<Real>(law.point.normal_stiffness);
    k_u = k_T / (1.0L + gamma_u_);
    k_v_ = law.point.normal_stiffness;
    const Real n0 = law.point.rest_load;
    first_touch_ =
        law.heights == ReferenceHeights::gaussian ? law.mean - 9.0L * law.deviation : 0.0L;
    if (k_v_ > 0.0L) {
      rest_ = n0 > 0.0L ? inverse(n0 / k_v_) + gamma_v_ * n0 / k_v_ : n0 / k_v_ * (1.0L + gamma_v_);
    }
  }

  [[nodiscard]] bool touches(Real x) const {
    if (k_v_ == 0.0L) return law_.point.rest_load > 0.0;
    return v_.at(x)[0] + rest_ > first_touch_;
  }

  [[nodiscard]] State at(Real x, bool turns) const {
    const auto u = u_.at(x);
    const auto v = v_.at(x);
    State y;
    const Real sigma = turns ? 0.0L : static_cast<Real>(frequency_) * std::abs(u[1]);
    Real mu_rate = 0.0L;
    coefficient(sigma, y.mu, mu_rate);
    if (k_v_ == 0.0L) {
      y.load = std::max<Real>(law_.point.rest_load, 0.0L);
      set_reach(y, y.load, 0.0L, v[1], mu_rate, u, turns);
      return y;
    }
    const Real closure = v[0] + rest_;
    if (closure <= first_touch_) return y.ratio = 0.0L, y;
    const Height h = height_at(law_, approach(closure));
    const Real du = 1.0L / (1.0L + gamma_v_ * h.share);
    y.load = k_v_ * h.delta;
    y.ratio = h.share * (1.0L + gamma_u_) / (1.0L + gamma_u_ * h.share);
    const Real per_ratio = k_v_ * (h.reach + gamma_u_ * h.delta) / (1.0L + gamma_u_);
    const Real per_ratio_rate = k_v_ * (h.reach_rate + gamma_u_ * h.share) / (1.0L + gamma_u_) * du;
    set_reach(y, per_ratio, per_ratio_rate, v[1], mu_rate, u, turns);
    return y;
  }

  /// Approaches at which the load has a kink.
  [[nodiscard]] std::vector<Real> kinks() const {
    if (k_v_ == 0.0L) return {};
    if (law_.heights == ReferenceHeights::none) return {-rest_};
    const Real last = law_.heights == ReferenceHeights::cubic
                          ? static_cast<Real>(law_.height)
                          : law_.mean + 9.0L * static_cast<Real>(law_.deviation);
    return {first_touch_ - rest_, last + gamma_v_ * (last - law_.mean) - rest_};
  }

  [[nodiscard]] const Wave& u() const { return u_; }
  [[nodiscard]] const Wave& v() const { return v_; }
  [[nodiscard]] Real virgin() const { return -slider_mean_; }
  Real k_u = 0.0L;

 private:
  void coefficient(Real sigma, Real& mu, Real& rate) const {
    const Real mu_0 = law_.point.friction_coefficient;
    mu = mu_0;
    rate = 0.0L;
    if (law_.rate == ReferenceRate::exponential) {
      const Real fade = std::exp(-law_.decay * sigma);
      mu = law_.at_speed + (mu_0 - law_.at_speed) * fade;
      rate = -(mu_0 - law_.at_speed) * fade * law_.decay;
    } else if (law_.rate == ReferenceRate::hyperbolic) {
      const Real growth = 1.0L + law_.decay * sigma;
      mu = mu_0 / growth;
      rate = -mu * law_.decay / growth;
    }
  }
  void set_reach(State& y, Real per_ratio, Real per_ratio_rate, Real v_rate, Real mu_rate,
                 const std::array<Real, 3>& u, bool turns) const {
    if (k_u == 0.0L) return;
    y.reach = y.mu * per_ratio / k_u;
    y.reach_rate = y.mu * per_ratio_rate * v_rate / k_u;
    if (turns) return;
    y.reach_rate += mu_rate * frequency_ * (u[1] < 0.0L ? -1.0L : 1.0L) * u[2] * per_ratio / k_u;
  }
  /// δ(u) = f.
  [[nodiscard]] Real inverse(Real f) const {
    Real low =
        law_.heights == ReferenceHeights::gaussian ? law_.mean - 60.0L * law_.deviation : 0.0L;
    Real high = f + std::abs(static_cast<Real>(law_.mean)) + 10.0L * law_.deviation +
                static_cast<Real>(law_.height);
    for (int i = 0; i < 300; ++i) {
      const Real middle = (low + high) / 2.0L;
      (height_at(law_, middle).delta < f ? low : high) = middle;
    }
    return high;
  }
  /// u + γ δ(u) = closure.
  [[nodiscard]] Real approach(Real closure) const {
    if (gamma_v_ == 0.0L) return closure;
    Real low = std::min<Real>(closure, first_touch_);
    Real high = closure;
    if (gamma_v_ < 0.0L) {
      high = closure;
      while (high + gamma_v_ * height_at(law_, high).delta < closure) {
        high += std::abs(closure) + static_cast<Real>(law_.height) + law_.deviation;
      }
    }
    Real u = (low + high) / 2.0L;
    for (int i = 0; i < 200; ++i) {  // Newton's method within the bracket
      const Height h = height_at(law_, u);
      const Real beyond = u + gamma_v_ * h.delta - closure;
      (beyond < 0.0L ? low : high) = u;
      Real next = u - beyond / (1.0L + gamma_v_ * h.share);
      if (!(next > low && next < high)) next = (low + high) / 2.0L;
      if (next == u || next == low || next == high) break;
      u = next;
    }
    return u;
  }

  const ReferenceLaw& law_;
  Wave u_, v_;
  Real frequency_;
  Real slider_mean_ = 0.0L, gamma_u_ = 0.0L, gamma_v_ = 0.0L, k_v_ = 0.0L;
  Real first_touch_ = 0.0L, rest_ = 0.0L;
};

}  // namespace microslip::test
