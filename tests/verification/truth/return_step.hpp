/// @file
/// One point from one instant to the next under the law of sampled_return.hpp, for numbers and for
/// numbers with a derivative.
#pragma once

#include <cmath>

#include "tests/verification/truth/dual_number.hpp"
#include "tests/verification/truth/sampled_return.hpp"

namespace microslip::truth {

/// A motion [m], or a traction [Pa], along p, q, r.
template <typename T>
struct Triple {
  T u{}, v{}, w{};
};

enum class State : unsigned char { open, stick, slip };

/// What a point remembers from one instant to the next.
template <typename T>
struct Slider {
  Triple<T> motion;
  T gap{};            ///< n₀ + k_n v; below zero: apart
  Triple<T> force{};  ///< v: normal pressure ≥ 0
  State state = State::open;
};

/// F* returned to the cone of normal pressure n.
template <typename T>
State return_to_cone(T& u, T& w, const T& n, double mu, bool planar) {
  using std::hypot;
  const T limit = mu * n;
  if (!planar) {
    if (std::abs(value_of(u)) <= value_of(limit)) return State::stick;
    u = value_of(u) > 0.0 ? limit : T(-1.0) * limit;
    return State::slip;
  }
  const T size = hypot(u, w);
  if (value_of(size) <= value_of(limit)) return State::stick;
  u = limit * u / size;
  w = limit * w / size;
  return State::slip;
}

/// The first instant, with a slider that was never moved.
template <typename T>
Slider<T> first_instant(const ContactConstants& c, bool planar, const Triple<T>& motion) {
  Slider<T> at{motion, T(c.pressure) + T(c.normal_stiffness) * motion.v};
  if (value_of(at.gap) <= 0.0) return at;
  const double k = c.tangential_stiffness;
  at.force = {T(k) * motion.u, at.gap, T(k) * motion.w};
  at.state = return_to_cone(at.force.u, at.force.w, at.gap, c.friction_coefficient, planar);
  return at;
}

template <typename T>
Slider<T> next_instant(const ContactConstants& c, bool planar, const Slider<T>& before,
                       const Triple<T>& motion) {
  Slider<T> at{motion, T(c.pressure) + T(c.normal_stiffness) * motion.v};
  if (value_of(at.gap) <= 0.0) return at;
  T stiffness = T(c.tangential_stiffness);
  if (value_of(before.gap) < 0.0) {
    stiffness = stiffness * at.gap / (at.gap - before.gap);
  } else {
    at.force = before.force;
  }
  at.force.v = at.gap;
  at.force.u = at.force.u + stiffness * (motion.u - before.motion.u);
  if (planar) at.force.w = at.force.w + stiffness * (motion.w - before.motion.w);
  at.state = return_to_cone(at.force.u, at.force.w, at.gap, c.friction_coefficient, planar);
  return at;
}

}  // namespace microslip::truth
