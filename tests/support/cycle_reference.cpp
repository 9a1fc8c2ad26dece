#include "support/cycle_reference.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

namespace microslip::test {
namespace {

using Real = long double;
constexpr Real pi = std::numbers::pi_v<Real>;
constexpr int n_cells = 32;  // per period; a guard with one harmonic turns twice per period
constexpr int n_nodes = 24;  // integrands of degree 2 over at most one period: exact to rounding

struct Instant {
  explicit Instant(Real at) : angle(at), sin(std::sin(at)), cos(std::cos(at)) {}
  Real angle;
  Real sin;
  Real cos;
};

// Value and derivative of a0 + as sin + ac cos at an angle.
struct Wave {
  Real mean = 0.0L;
  Real sin = 0.0L;
  Real cos = 0.0L;

  [[nodiscard]] Real at(const Instant& t) const { return mean + sin * t.sin + cos * t.cos; }
  [[nodiscard]] Real rate(const Instant& t) const { return sin * t.cos - cos * t.sin; }
  [[nodiscard]] Real at(Real angle) const { return at(Instant(angle)); }
};

Wave operator+(const Wave& a, const Wave& b) {
  return {a.mean + b.mean, a.sin + b.sin, a.cos + b.cos};
}
Wave operator*(Real x, const Wave& a) { return {x * a.mean, x * a.sin, x * a.cos}; }
Wave derivative(const Wave& a) { return {0.0L, -a.cos, a.sin}; }

struct Quadrature {
  std::array<Real, n_nodes> node{};
  std::array<Real, n_nodes> weight{};
};

// Gauss–Legendre on [−1, 1] by Newton's method on the three-term recurrence.
Quadrature gauss_legendre() {
  Quadrature rule;
  for (int i = 0; i < n_nodes; ++i) {
    Real x = std::cos(pi * (i + 0.75L) / (n_nodes + 0.5L));
    Real slope = 0.0L;
    for (int iteration = 0; iteration < 20; ++iteration) {
      Real before = 1.0L;
      Real value = x;
      for (int k = 2; k <= n_nodes; ++k) {
        const Real next = ((2 * k - 1) * x * value - (k - 1) * before) / k;
        before = value;
        value = next;
      }
      slope = n_nodes * (x * value - before) / (x * x - 1.0L);
      x -= value / slope;
    }
    rule.node[static_cast<std::size_t>(i)] = x;
    rule.weight[static_cast<std::size_t>(i)] = 2.0L / ((1.0L - x * x) * slope * slope);
  }
  return rule;
}

class March {
 public:
  March(const contact::PointParameters& point, const contact::PointMotion& m)
      : k_u_(point.tangential_stiffness),
        mu_(point.friction_coefficient),
        rest_(-k_u_ * static_cast<Real>(m.u_mean)),
        spring_{0.0L, k_u_ * static_cast<Real>(m.u_sin), k_u_ * static_cast<Real>(m.u_cos)} {
    const Real k_v = point.normal_stiffness;
    load_ = {std::fma(k_v, static_cast<Real>(m.v_mean), static_cast<Real>(point.rest_load)),
             k_v * m.v_sin, k_v * m.v_cos};
    const Real load = std::abs(load_.mean) + std::hypot(load_.sin, load_.cos);
    // A guard is broken when it is below zero by more than rounding; what a tolerance moves in time
    // it moves in force by no more than itself.
    load_tolerance_ = 1e-17L * load;
    tolerance_ = 1e-17L * (std::hypot(spring_.sin, spring_.cos) + mu_ * load);
  }

  ReferenceCycle run() {
    start();
    advance(2.0L * pi);
    recording_ = true;
    advance(4.0L * pi);
    order_sequence();
    return result_;
  }

 private:
  // A guard holds while it is at least −tolerance.
  struct Guard {
    Wave wave;
    Real tolerance;
    char next;
  };

  // Virgin slider, pushed into the band of the first instant.
  void start() {
    const Real limit = mu_ * load_.at(0.0L);
    if (limit <= 0.0L) {
      state_ = load_.at(0.0L) > 0.0L ? 'S' : 'E';
      slider_ = spring_.at(0.0L);
      return;
    }
    state_ = 'S';
    slider_ = std::clamp(rest_, spring_.at(0.0L) - limit, spring_.at(0.0L) + limit);
  }

  [[nodiscard]] std::vector<Guard> guards() const {
    switch (state_) {
      case 'P':
        return {{derivative(spring_ + (-mu_) * load_), tolerance_, 'S'},
                {load_, load_tolerance_, 'E'}};
      case 'N':
        return {{(-1.0L) * derivative(spring_ + mu_ * load_), tolerance_, 'S'},
                {load_, load_tolerance_, 'E'}};
      case 'E':
        return {{(-1.0L) * load_, load_tolerance_, 'S'}};
      default:
        break;
    }
    Wave friction = spring_;
    friction.mean -= slider_;
    return {{mu_ * load_ + (-1.0L) * friction, tolerance_, 'P'},
            {mu_ * load_ + friction, tolerance_, 'N'},
            {load_, load_tolerance_, 'E'}};
  }

  // First angle in (from, to] where the guard is broken, or `to` + 1 if there is none.
  static Real first_breach(const Guard& guard, const Instant& from, const Instant& to) {
    const auto broken = [&](Real angle) { return guard.wave.at(angle) < -guard.tolerance; };
    Real bad = to.angle;
    if (guard.wave.at(to) >= -guard.tolerance) {
      // A dip inside the cell: the guard falls at its begin and rises at its end.
      if (!(guard.wave.rate(from) < 0.0L && guard.wave.rate(to) > 0.0L)) {
        return to.angle + 1.0L;
      }
      bad = bisect(from.angle, to.angle,
                   [&](Real angle) { return guard.wave.rate(Instant(angle)) > 0.0L; });
      if (!broken(bad)) {
        return to.angle + 1.0L;
      }
    }
    return bisect(from.angle, bad, broken);
  }

  // Boundary between false (low) and true (high).
  template <typename Predicate>
  static Real bisect(Real low, Real high, const Predicate& predicate) {
    for (int i = 0; i < 64; ++i) {
      const Real middle = 0.5L * (low + high);
      (predicate(middle) ? high : low) = middle;
    }
    return high;
  }

  void advance(Real end) {
    for (int events = 0; time_ < end; ++events) {
      if (events > 400) {
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

  // One cell of the fixed grid, or up to the first broken guard.
  char step(const std::vector<Guard>& held, Real end) {
    const Real cell = 2.0L * pi / n_cells;
    const Instant from(time_);
    const Instant to(std::min(end, cell * (std::floor(time_ / cell + 1e-9L) + 1.0L)));
    Real first = to.angle;
    char next = state_;
    for (const Guard& guard : held) {
      const Real breach = first_breach(guard, from, to);
      if (breach <= first && (next == state_ || breach < first)) {
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

  [[nodiscard]] Real friction(const Instant& now) const {
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
    static const Quadrature rule = gauss_legendre();
    const Real half = 0.5L * (to - from);
    const Wave slip = derivative(spring_ + (state_ == 'P' ? -mu_ : mu_) * load_);
    for (std::size_t i = 0; i < n_nodes; ++i) {
      const Instant now(0.5L * (from + to) + half * rule.node[i]);
      const Real weight = half * rule.weight[i];
      const Real f = friction(now);
      const Real n = state_ == 'E' ? 0.0L : load_.at(now);
      const std::array<Real, 3> kernel{0.5L / pi, now.sin / pi, now.cos / pi};
      for (std::size_t k = 0; k < 3; ++k) {
        result_.friction[k] += weight * kernel[k] * f;
        result_.normal[k] += weight * kernel[k] * n;
      }
      if ((state_ == 'P' || state_ == 'N') && k_u_ > 0.0L) {
        const Real rate = std::abs(slip.at(now)) / k_u_;
        result_.slip_distance += weight * rate;
        result_.dissipated_energy += weight * rate * mu_ * n;
      }
    }
    // Phases of rounding length come from the tolerances, not from the motion.
    if (to - from > 1e-7L && (result_.sequence.empty() || result_.sequence.back() != state_)) {
      result_.sequence.push_back(state_);
    }
  }

  // Rotates the sequence so that separation, if any, stands last; drops the repeated end.
  void order_sequence() {
    std::string& s = result_.sequence;
    if (s.size() > 1 && s.front() == s.back()) {
      s.pop_back();
    }
    const std::size_t open = s.find('E');
    if (open != std::string::npos) {
      std::rotate(s.begin(), s.begin() + static_cast<std::ptrdiff_t>(open) + 1, s.end());
    }
  }

  Real k_u_;
  Real mu_;
  Real rest_;    // virgin slider, s = 0
  Wave spring_;  // k_u (u − u₀)
  Wave load_;    // n₀ + k_v v
  Real tolerance_ = 0.0L;
  Real load_tolerance_ = 0.0L;
  Real slider_ = 0.0L;  // k_u (s − u₀)
  Real time_ = 0.0L;
  char state_ = 'S';
  bool recording_ = false;
  ReferenceCycle result_;
};

}  // namespace

ReferenceCycle reference_cycle(const contact::PointParameters& point,
                               const contact::PointMotion& motion) {
  return March(point, motion).run();
}

}  // namespace microslip::test
