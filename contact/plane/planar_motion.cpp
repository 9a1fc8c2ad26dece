#include "contact/plane/planar_motion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace microslip::contact {
namespace {

constexpr Eigen::Index n_signals = 3;  // u, v, w

/// Signals u, v, w and their first two derivatives at one phase.
struct Signals {
  Eigen::Vector3d value = Eigen::Vector3d::Zero();
  Eigen::Vector3d rate = Eigen::Vector3d::Zero();
  Eigen::Vector3d second = Eigen::Vector3d::Zero();
};

/// Without the mean.
Signals signals(const Harmonics& motion, double phase) {
  const double s1 = std::sin(phase);
  const double c1 = std::cos(phase);
  const double* row = motion.rows().data() + n_signals;
  Signals x;
  double s = s1;
  double c = c1;
  for (int h = 1; h <= motion.n_harmonics(); ++h) {
    const double order = h;
    for (Eigen::Index i = 0; i < n_signals; ++i) {
      const double sine = row[i];
      const double cosine = row[i + n_signals];
      const double value = sine * s + cosine * c;
      x.value[i] += value;
      x.rate[i] += order * (sine * c - cosine * s);
      x.second[i] -= order * order * value;
    }
    row += 2 * n_signals;
    const double next = s * c1 + c * s1;
    c = c * c1 - s * s1;
    s = next;
  }
  return x;
}

Eigen::Vector2d tangential(const Eigen::Vector3d& x) { return {x[0], x[2]}; }

}  // namespace

PlanarMotion::PlanarMotion(const SurfaceLaw& law, const Harmonics& motion, double frequency)
    : law_(law),
      harmonics_(motion),
      frequency_(frequency),
      is_smooth_(law.is_smooth()),
      depends_on_rate_(law.is_rate_dependent()),
      mean_approach_(motion.mean()[1]) {
  set_scales();
}

void PlanarMotion::set_scales() {
  const Eigen::Vector2d k(law_.first_stiffness(), law_.second_stiffness());
  const double largest = k.maxCoeff();
  if (largest <= 0.0 || !law_.has_friction()) return;
  Eigen::Vector2d amplitude = Eigen::Vector2d::Zero();
  for (int h = 1; h <= n_harmonics(); ++h) {
    amplitude[0] += std::hypot(harmonics_.sine(h)[0], harmonics_.cosine(h)[0]);
    amplitude[1] += std::hypot(harmonics_.sine(h)[2], harmonics_.cosine(h)[2]);
  }
  double radius = 0.0;
  force_scale_ = 1.0;
  const int n_samples = 8 * n_harmonics();  // a scale, not a bound: short contacts may be missed
  for (int i = 0; i < n_samples; ++i) {
    radius = std::max(radius, at(2.0 * std::numbers::pi * i / n_samples).limit);
  }
  const double spring = k.cwiseProduct(amplitude).sum();
  const double scale = radius + spring;
  // Below this, products of scaled numbers would be subnormal; the force is zero to 1e-290.
  constexpr double smallest = 1e-290;
  const bool counts = scale > smallest && std::isfinite(scale) && std::isfinite(largest / scale);
  force_scale_ = counts ? scale : 0.0;
  if (force_scale_ == 0.0) return;
  friction_share_ = 2.0 * std::min(radius, spring) / scale;
  length_scale_ = force_scale_ / largest;
  active_ = (k.array() > 0.0).cast<double>();
  per_length_ = active_ * (largest / scale);
  per_force_ = 1.0 / scale;
  stiffness_ = (k.array() > 0.0).select(k / largest, 1.0);
}

PlanarInstant PlanarMotion::at(double phase) const {
  const Signals x = signals(harmonics_, phase);
  PlanarInstant now;
  now.phase = phase;
  now.position = tangential(x.value).cwiseProduct(per_length_);
  now.velocity = tangential(x.rate).cwiseProduct(per_length_);
  now.approach_rate = x.rate[1];
  double speed_rate = 0.0;
  if (depends_on_rate_) {
    const Eigen::Vector2d velocity = tangential(x.rate);
    now.speed = std::hypot(velocity[0], velocity[1]);
    if (now.speed > 0.0) {
      now.heading = velocity / now.speed;
      speed_rate = now.heading.dot(tangential(x.second));
    }
  }
  now.surface = law_.at(mean_approach_ + x.value[1], frequency_ * now.speed);
  const SurfaceState& y = now.surface;
  now.stiffness = stiffness_;
  if (!is_smooth_) {
    now.stiffness[1] *= y.ratio_of_stiffness;
    now.stiffness_by_approach[1] = stiffness_[1] * y.ratio_of_stiffness_by_approach;
    now.stiffness_rate[1] = now.stiffness_by_approach[1] * now.approach_rate;
  }
  if (force_scale_ == 0.0 || y.load <= 0.0 || y.stiffness_ratio <= 0.0) return now;
  const double mu = y.friction_coefficient;
  const double ratio = y.load_per_ratio * per_force_;
  now.limit = mu * ratio;
  now.radius = std::max(now.limit, least_radius);
  now.radius_by_approach = mu * (y.load_per_ratio_by_approach * per_force_);
  now.radius_by_rate = y.friction_coefficient_by_rate * ratio;
  now.radius_rate =
      now.radius_by_approach * now.approach_rate + now.radius_by_rate * frequency_ * speed_rate;
  return now;
}

PlanarInstant PlanarMotion::at(double phase, double nudge) const {
  PlanarInstant now = at(phase);
  if (nudge == 0.0) return now;
  const PlanarInstant beside = at(phase + nudge);
  // The radius of Gaussian heights is not zero where contact begins, nor is it on both sides.
  const bool jumps = now.radius == 0.0 && !law_.is_smooth();
  if (jumps) {
    now.limit = std::max(0.0, beside.limit - nudge * beside.radius_rate);
    now.radius = std::max(now.limit, least_radius);
  }
  now.radius_rate = beside.radius_rate;
  now.radius_by_approach = beside.radius_by_approach;
  now.stiffness_rate = beside.stiffness_rate;
  now.stiffness_by_approach = beside.stiffness_by_approach;
  now.radius_by_rate = beside.radius_by_rate;
  now.heading = beside.heading;
  now.surface.load_by_approach = beside.surface.load_by_approach;
  now.surface.stiffness_ratio_by_approach = beside.surface.stiffness_ratio_by_approach;
  now.surface.second_stiffness_ratio_by_approach =
      beside.surface.second_stiffness_ratio_by_approach;
  now.surface.friction_coefficient_by_rate = beside.surface.friction_coefficient_by_rate;
  return now;
}

Eigen::Vector2d PlanarMotion::tangential_acceleration(double phase) const {
  return tangential(signals(harmonics_, phase).second);
}

Eigen::Vector2d PlanarMotion::virgin_slider() const {
  const Eigen::Vector2d mean(harmonics_.mean()[0], harmonics_.mean()[2]);
  // Farther away only the direction counts, and squares would overflow.
  constexpr double farthest = 1e120;
  Eigen::Vector2d slider = -mean.cwiseProduct(active_) / length_scale_;
  const double size = slider.cwiseAbs().maxCoeff();
  if (size > farthest) {
    slider = -mean.cwiseProduct(active_) / mean.cwiseAbs().maxCoeff() * farthest;
  }
  return slider;
}

}  // namespace microslip::contact
