#include "contact/plane/planar_point.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "contact/plane/planar_slip.hpp"

namespace microslip::contact {
namespace {

using Eigen::Vector2d;

Vector2d tangential(const Eigen::Vector3d& motion) { return {motion[0], motion[2]}; }
Vector2d across(const Vector2d& e) { return {-e[1], e[0]}; }

/// β' of (3), fading out where the motion is too slow to be followed (|x'|² ≪ |x''| reach) and
/// where slip does not follow it: friction of a falling load may drive the slider against the
/// motion.
double heading_rate(const PlanarPointInstant& now, const Vector2d& e, double reach) {
  const double speed = now.velocity.norm();
  const double square = speed * speed + now.acceleration.norm() * reach;
  if (square == 0.0 || speed == 0.0) return 0.0;
  const double along = std::max(0.0, e.dot(now.velocity) / speed);
  return along * along * across(now.velocity).dot(now.acceleration) / square;
}

/// R of (3).
double held_radius(const PlanarPointInstant& now, double edge) {
  return std::sqrt(std::hypot(now.radius * now.radius, edge * edge));
}

/// ρ_∞ of (4): the largest root of Σ (x'_i / (ρ + D_i))² = 1 with D = (r C)', by Newton's method on
/// the inverse root of the sum, which is concave: monotone from the left.
double settled_slip_speed(const Vector2d& velocity, const Vector2d& reach_rate) {
  const double speed = velocity.norm();
  const double least = -reach_rate.minCoeff();
  double rho = std::max(speed - reach_rate.maxCoeff(), least);
  constexpr int enough = 8;  // from 3 digits of a far start to rounding
  for (int i = 0; i < enough; ++i) {
    const Eigen::Array2d width = rho + reach_rate.array();
    if (!(width > 0.0).all()) {
      // At the pole: half of the way to the upper bound.
      rho = 0.5 * (rho + std::max(speed + least, rho));
      if (speed == 0.0) return least;
      continue;
    }
    const Eigen::Array2d share = velocity.array() / width;
    const double size = std::sqrt(share.square().sum());
    const double slope = (share.square() / width).sum() / (size * size * size);
    if (!(slope > 0.0)) break;
    const double step = (1.0 - 1.0 / size) / slope;
    rho += step;
    if (std::abs(step) <= 1e-14 * std::abs(rho)) break;
  }
  return rho;
}

/// What slip sees of an instant.
PlanarInstant as_planar(const PlanarPointInstant& now) {
  PlanarInstant instant;
  instant.velocity = now.velocity;
  instant.stiffness = now.stiffness;
  instant.stiffness_rate = now.stiffness_rate;
  instant.radius = now.radius;
  instant.radius_rate = now.radius_rate;
  return instant;
}

}  // namespace

PlanarPoint::PlanarPoint(const SurfaceLaw& surface, double tangential, double normal,
                         bool moves_along_r)
    : law(surface),
      touch(std::numeric_limits<double>::quiet_NaN()),
      load_size(std::max(surface.reference_load(), std::abs(surface.point().rest_load))),
      tangential_size(tangential),
      normal_size(normal) {
  const Vector2d k(surface.first_stiffness(), moves_along_r ? surface.second_stiffness() : 0.0);
  stiffness = (k.array() > 0.0).select(k, 1.0);
  active = (k.array() > 0.0).cast<double>();
  rubs = surface.has_friction() && (k.array() > 0.0).any();
  const std::vector<double> kinks = surface.kinks();
  if (kinks.empty()) return;
  touch = kinks.front();
  load_size = std::max(load_size, surface.point().normal_stiffness * std::abs(touch));
}

PlanarPointInstant instant_of(const PlanarPoint& point, const PlanarPointMotion& motion,
                              double least_approach) {
  const SurfaceLaw& law = point.law;
  const Vector2d rate = tangential(motion.rate);
  PlanarPointInstant now;
  now.position = tangential(motion.value).cwiseProduct(point.active);
  now.velocity = rate.cwiseProduct(point.active);
  now.acceleration = tangential(motion.second).cwiseProduct(point.active);
  const double speed = law.is_rate_dependent() ? rate.norm() : 0.0;
  const double speed_rate = speed > 0.0 ? rate.dot(tangential(motion.second)) / speed : 0.0;
  const double approach = std::max(motion.value[1], least_approach);
  const double stiffness = law.point().normal_stiffness;
  const SurfaceState y = law.at(approach, speed);
  now.stiffness = point.stiffness;
  now.stiffness[1] *= y.ratio_of_stiffness;
  now.stiffness_rate[1] = point.stiffness[1] * y.ratio_of_stiffness_by_approach * motion.rate[1];
  const bool smooth = law.is_smooth();
  const bool never_apart = std::isnan(point.touch);
  now.normal = smooth ? y.gap_load : y.load;
  now.load = smooth        ? y.gap_load
             : never_apart ? point.load_size
                           : stiffness * (approach - point.touch);
  now.ratio = y.stiffness_ratio;
  const double per_ratio = smooth ? y.gap_load : y.load_per_ratio;
  const double per_ratio_by_approach = smooth ? stiffness : y.load_per_ratio_by_approach;
  now.radius = y.friction_coefficient * per_ratio;
  now.radius_rate = y.friction_coefficient * per_ratio_by_approach * motion.rate[1] +
                    y.friction_coefficient_by_rate * per_ratio * speed_rate;
  return now;
}

double just_inside(const PlanarPoint& point) {
  const std::vector<double> kinks = point.law.kinks();
  // Smooth surfaces have a single kink, and instant_of() continues them through it.
  if (kinks.size() < 2) return -std::numeric_limits<double>::infinity();
  constexpr double inside = 1e-9;  // of the height: r' changes by as much
  return kinks[0] + inside * (kinks[1] - kinks[0]);
}

Vector2d spring_force(const PlanarPoint& point, const PlanarPointInstant& now,
                      const Vector2d& slider) {
  return now.stiffness.cwiseProduct(now.position - slider).cwiseProduct(point.active);
}

Vector2d slip_direction(double angle) { return {std::cos(angle), std::sin(angle)}; }

double slip_speed(const PlanarPointInstant& now, double angle) {
  return slip_rate(as_planar(now), slip_direction(angle));
}

double starting_angle(const PlanarPoint& point, const PlanarPointInstant& now,
                      const Vector2d& force, double edge) {
  Vector2d e = force.normalized();
  const double share = now.radius / held_radius(now, edge);
  if (point.active.sum() == 2.0 && share < 1.0) {
    const Vector2d reach_rate = as_planar(now).reach_rate();
    const double rho = settled_slip_speed(now.velocity, reach_rate);
    const Eigen::Array2d speed = rho + reach_rate.array();
    if (rho > 0.0 && (speed != 0.0).all()) {
      const Eigen::Array2d settled = now.velocity.array() / speed;
      if (settled.allFinite()) e = share * e + (1.0 - share) * settled.matrix();
    }
  }
  return std::atan2(e[1], e[0]);
}

double turn_rate(const PlanarPoint& point, const PlanarPointInstant& now, double angle,
                 double edge) {
  if (point.active.sum() < 2.0) return 0.0;
  const Vector2d e = slip_direction(angle);
  const Vector2d turn = across(e);
  const Vector2d compliance = now.stiffness.cwiseInverse();
  const Vector2d dragged = now.velocity - as_planar(now).reach_rate().cwiseProduct(e);
  const double across_compliance = turn.dot(compliance.cwiseProduct(turn));
  const double radius = held_radius(now, edge);
  const double fed = heading_rate(now, e, radius * compliance.maxCoeff());
  return fed + (turn.dot(dragged) / across_compliance - now.radius * fed) / radius;
}

}  // namespace microslip::contact
