#include "support/motion_reference.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <stdexcept>

namespace microslip::test {
namespace {

using Real = long double;
constexpr Real pi = std::numbers::pi_v<Real>;
constexpr std::size_t n_nodes = 12;

// a0 + Σ (as sin hθ + ac cos hθ).
struct Wave {
  Real mean = 0.0L;
  std::vector<Real> sin;
  std::vector<Real> cos;

  [[nodiscard]] Real at(Real angle) const {
    const Real s = std::sin(angle);
    const Real c = std::cos(angle);
    Real re = 1.0L;
    Real im = 0.0L;
    Real sum = mean;
    for (std::size_t i = 0; i < sin.size(); ++i) {
      const Real next = re * c - im * s;
      im = re * s + im * c;
      re = next;
      sum += sin[i] * im + cos[i] * re;
    }
    return sum;
  }
  [[nodiscard]] Real size() const {
    Real sum = 0.0L;
    for (std::size_t i = 0; i < sin.size(); ++i) {
      sum += std::hypot(sin[i], cos[i]);
    }
    return sum;
  }
  [[nodiscard]] Real curvature() const {
    Real sum = 0.0L;
    for (std::size_t i = 0; i < sin.size(); ++i) {
      sum += static_cast<Real>((i + 1) * (i + 1)) * std::hypot(sin[i], cos[i]);
    }
    return sum;
  }
};

Wave combined(Real x, const Wave& a, Real y, const Wave& b) {
  Wave sum{x * a.mean + y * b.mean, a.sin, a.cos};
  for (std::size_t i = 0; i < sum.sin.size(); ++i) {
    sum.sin[i] = x * a.sin[i] + y * b.sin[i];
    sum.cos[i] = x * a.cos[i] + y * b.cos[i];
  }
  return sum;
}

Wave derivative(const Wave& a) {
  Wave d{0.0L, a.cos, a.sin};
  for (std::size_t i = 0; i < a.sin.size(); ++i) {
    d.sin[i] = -static_cast<Real>(i + 1) * a.cos[i];
    d.cos[i] = static_cast<Real>(i + 1) * a.sin[i];
  }
  return d;
}

struct Quadrature {
  std::array<Real, n_nodes> node{};
  std::array<Real, n_nodes> weight{};
};

// Gauss–Legendre on [−1, 1] by Newton's method on the three-term recurrence.
Quadrature gauss_legendre() {
  Quadrature rule;
  for (std::size_t i = 0; i < n_nodes; ++i) {
    Real x = std::cos(pi * (static_cast<Real>(i) + 0.75L) / (n_nodes + 0.5L));
    Real slope = 0.0L;
    for (int iteration = 0; iteration < 20; ++iteration) {
      Real before = 1.0L;
      Real value = x;
      for (int k = 2; k <= static_cast<int>(n_nodes); ++k) {
        const Real next = ((2 * k - 1) * x * value - (k - 1) * before) / k;
        before = value;
        value = next;
      }
      slope = n_nodes * (x * value - before) / (x * x - 1.0L);
      x -= value / slope;
    }
    rule.node[i] = x;
    rule.weight[i] = 2.0L / ((1.0L - x * x) * slope * slope);
  }
  return rule;
}

// Holds while wave ≥ −tolerance.
struct Guard {
  Wave wave;
  Real tolerance;
  char next;
  Real curvature = 0.0L;
};

constexpr Real none = -1.0L;

// First angle in (from, to] where the guard is broken.
Real first_breach(const Guard& guard, Real from, Real at_from, Real to, Real at_to) {
  const Real width = to - from;
  if (std::min(at_from, at_to) - guard.curvature * width * width / 8.0L >= -guard.tolerance) {
    return none;
  }
  if (width < 1e-9L) {
    if (at_to >= -guard.tolerance) {
      return none;
    }
    for (int i = 0; i < 34; ++i) {
      const Real middle = 0.5L * (from + to);
      (guard.wave.at(middle) < -guard.tolerance ? to : from) = middle;
    }
    return to;
  }
  const Real middle = 0.5L * (from + to);
  const Real at_middle = guard.wave.at(middle);
  const Real left = first_breach(guard, from, at_from, middle, at_middle);
  return left != none ? left : first_breach(guard, middle, at_middle, to, at_to);
}

class March {
 public:
  March(const contact::PointParameters& point, const contact::Harmonics& motion, int n_harmonics)
      : k_u_(point.tangential_stiffness), mu_(point.friction_coefficient) {
    const Real k_v = point.normal_stiffness;
    const auto& rows = motion.rows();
    rest_ = -k_u_ * static_cast<Real>(rows(0, 0));
    load_.mean = static_cast<Real>(point.rest_load) + k_v * static_cast<Real>(rows(0, 1));
    for (int h = 1; h <= motion.n_harmonics(); ++h) {
      spring_.sin.push_back(k_u_ * static_cast<Real>(rows(2 * h - 1, 0)));
      spring_.cos.push_back(k_u_ * static_cast<Real>(rows(2 * h, 0)));
      load_.sin.push_back(k_v * static_cast<Real>(rows(2 * h - 1, 1)));
      load_.cos.push_back(k_v * static_cast<Real>(rows(2 * h, 1)));
    }
    const Real load = std::abs(load_.mean) + load_.size();
    // A guard is broken when it is below zero by more than rounding.
    load_tolerance_ = 2e-18L * load;
    tolerance_ = 2e-18L * (spring_.size() + mu_ * load);
    result_.friction.assign(2 * static_cast<std::size_t>(n_harmonics) + 1, 0.0L);
    result_.normal = result_.friction;
  }

  MotionReference run() {
    start();
    advance(2.0L * pi);
    recording_ = true;
    advance(4.0L * pi);
    return result_;
  }

 private:
  // Virgin slider, pushed into the band of the first instant.
  void start() {
    const Real limit = mu_ * load_.at(0.0L);
    const Real spring = spring_.at(0.0L);
    state_ = load_.at(0.0L) > 0.0L ? 'S' : 'E';
    slider_ = limit > 0.0L ? std::clamp(rest_, spring - limit, spring + limit) : spring;
  }

  [[nodiscard]] Guard guard(const Wave& wave, Real tolerance, char next) const {
    return {wave, tolerance, next, wave.curvature()};
  }

  [[nodiscard]] std::vector<Guard> guards() const {
    const Real slow = tolerance_ * static_cast<Real>(spring_.sin.size());
    switch (state_) {
      case 'P':
        return {guard(derivative(combined(1.0L, spring_, -mu_, load_)), slow, 'S'),
                guard(load_, load_tolerance_, 'E')};
      case 'N':
        return {guard(derivative(combined(-1.0L, spring_, -mu_, load_)), slow, 'S'),
                guard(load_, load_tolerance_, 'E')};
      case 'E':
        return {guard(combined(0.0L, spring_, -1.0L, load_), load_tolerance_, 'S')};
      default:
        break;
    }
    Wave friction = spring_;
    friction.mean -= slider_;
    return {guard(combined(-1.0L, friction, mu_, load_), tolerance_, 'P'),
            guard(combined(1.0L, friction, mu_, load_), tolerance_, 'N'),
            guard(load_, load_tolerance_, 'E')};
  }

  void advance(Real end) {
    for (int events = 0; time_ < end; ++events) {
      if (events > 2000) {
        throw std::runtime_error("reference cycle: the march does not end");
      }
      const Real from = time_;
      char next = state_;
      const std::vector<Guard> held = guards();
      while (time_ < end && next == state_) {
        next = step(held, end);
      }
      if (recording_) {
        record(from, time_);
      }
      change(next);
    }
  }

  // One cell of a fixed grid, or up to the first broken guard.
  char step(const std::vector<Guard>& held, Real end) {
    const Real cell = pi / (4.0L * static_cast<Real>(spring_.sin.size()));
    const Real from = time_;
    const Real to = std::min(end, cell * (std::floor(time_ / cell + 1e-9L) + 1.0L));
    Real first = to;
    char next = state_;
    for (const Guard& guard : held) {
      const Real breach = first_breach(guard, from, guard.wave.at(from), to, guard.wave.at(to));
      if (breach != none && breach <= first && (next == state_ || breach < first)) {
        first = breach;
        next = guard.next;
      }
    }
    time_ = first;
    return next;
  }

  void change(char next) {
    if (next == state_) {
      return;
    }
    if (next == 'S') {
      const Real limit = state_ == 'E' ? 0.0L : mu_ * load_.at(time_);
      slider_ = spring_.at(time_) + (state_ == 'P' ? -limit : limit);
    }
    state_ = next;
  }

  [[nodiscard]] Real friction(Real now) const {
    switch (state_) {
      case 'P':
        return mu_ * load_.at(now);
      case 'N':
        return -mu_ * load_.at(now);
      case 'S':
        return k_u_ == 0.0L || mu_ == 0.0L ? 0.0L : spring_.at(now) - slider_;
      default:
        return 0.0L;
    }
  }

  void record(Real from, Real to) {
    const auto highest =
        static_cast<Real>(std::max(spring_.sin.size(), result_.friction.size() / 2));
    const int pieces = 1 + static_cast<int>((to - from) * highest);
    const Real width = (to - from) / pieces;
    for (int i = 0; i < pieces; ++i) {
      record_piece(from + i * width, width);
    }
    // Phases of rounding length come from the tolerances, not from the motion.
    if (to - from > 1e-7L && (result_.sequence.empty() || result_.sequence.back() != state_)) {
      result_.sequence.push_back(state_);
    }
  }

  void record_piece(Real from, Real width) {
    static const Quadrature rule = gauss_legendre();
    const Wave slip = derivative(combined(1.0L, spring_, state_ == 'P' ? -mu_ : mu_, load_));
    for (std::size_t i = 0; i < n_nodes; ++i) {
      const Real now = from + 0.5L * width * (1.0L + rule.node[i]);
      const Real weight = 0.5L * width * rule.weight[i];
      const Real f = friction(now);
      const Real n = state_ == 'E' ? 0.0L : load_.at(now);
      add(result_.friction, weight * f, now);
      add(result_.normal, weight * n, now);
      if ((state_ == 'P' || state_ == 'N') && k_u_ > 0.0L) {
        const Real rate = std::abs(slip.at(now)) / k_u_;
        result_.slip_distance += weight * rate;
        result_.dissipated_energy += weight * rate * mu_ * n;
      }
    }
  }

  static void add(std::vector<Real>& series, Real value, Real now) {
    series[0] += 0.5L / pi * value;
    const Real s = std::sin(now);
    const Real c = std::cos(now);
    Real re = 1.0L;
    Real im = 0.0L;
    for (std::size_t h = 1; 2 * h < series.size(); ++h) {
      const Real next = re * c - im * s;
      im = re * s + im * c;
      re = next;
      series[2 * h - 1] += value * im / pi;
      series[2 * h] += value * re / pi;
    }
  }

  Real k_u_;
  Real mu_;
  Real rest_ = 0.0L;  // virgin slider, s = 0
  Wave spring_;       // k_u (u − u₀)
  Wave load_;         // n₀ + k_v v
  Real tolerance_ = 0.0L;
  Real load_tolerance_ = 0.0L;
  Real slider_ = 0.0L;  // k_u (s − u₀)
  Real time_ = 0.0L;
  char state_ = 'S';
  bool recording_ = false;
  MotionReference result_;
};

}  // namespace

MotionReference motion_reference(const contact::PointParameters& point,
                                 const contact::Harmonics& motion, int n_harmonics) {
  return March(point, motion, n_harmonics).run();
}

}  // namespace microslip::test
