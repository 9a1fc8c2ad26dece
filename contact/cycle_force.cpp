#include "contact/cycle_force.hpp"

#include <algorithm>
#include <array>
#include <numbers>

namespace microslip::contact {
namespace {

constexpr double pi = std::numbers::pi;

// Integrals over a set of phases of 1, sin, cos and of their products (theory section 5).
struct Integrals {
  double one = 0.0;
  double sin = 0.0;
  double cos = 0.0;
  double sin_sin = 0.0;
  double sin_cos = 0.0;
  double cos_cos = 0.0;

  Integrals& operator+=(const Integrals& other) {
    one += other.one;
    sin += other.sin;
    cos += other.cos;
    sin_sin += other.sin_sin;
    sin_cos += other.sin_cos;
    cos_cos += other.cos_cos;
    return *this;
  }
};

// From `a` to `b`, an angle `length` later. Exact to rounding of O(1), which is what a coefficient
// that is compared with the amplitude of the force needs.
Integrals integrals(const Direction& a, const Direction& b, double length) {
  const double product = 0.5 * (b.sin * b.cos - a.sin * a.cos);
  return {.one = length,
          .sin = a.cos - b.cos,
          .cos = b.sin - a.sin,
          .sin_sin = 0.5 * length - product,
          .sin_cos = 0.5 * (b.sin - a.sin) * (b.sin + a.sin),
          .cos_cos = 0.5 * length + product};
}

Integrals difference(const Integrals& a, const Integrals& b) {
  return {a.one - b.one,         a.sin - b.sin,         a.cos - b.cos,
          a.sin_sin - b.sin_sin, a.sin_cos - b.sin_cos, a.cos_cos - b.cos_cos};
}

// Integrals of one period, gathered by what the force does.
struct PhaseSums {
  std::array<Integrals, 6> by_kind;  // indexed by PhaseKind

  const Integrals& operator[](PhaseKind kind) const {
    return by_kind[static_cast<std::size_t>(kind)];
  }
};

PhaseSums phase_sums(const CyclePhases& phases) {
  PhaseSums sums;
  for (int i = 0; i < phases.n_phases; ++i) {
    const CyclePhase& phase = phases.phase[static_cast<std::size_t>(i)];
    const int next = i + 1 < phases.n_phases ? i + 1 : 0;
    sums.by_kind[static_cast<std::size_t>(phase.kind)] +=
        integrals(phase.begin, phases.phase[static_cast<std::size_t>(next)].begin, phase.length);
  }
  return sums;
}

// From touch-down to lift-off; separation is the last phase.
Integrals contact_integrals(const CyclePhases& phases) {
  const auto last = static_cast<std::size_t>(phases.n_phases - 1);
  double length = 0.0;
  for (std::size_t i = 0; i < last; ++i) {
    length += phases.phase[i].length;
  }
  return integrals(phases.phase[0].begin, phases.phase[last].begin, length);
}

// A force offset c that is frozen during a stick phase, and its derivatives (theory section 6).
struct Memory {
  double value = 0.0;
  std::array<double, 2> by_u{};  // u_s, u_c
  std::array<double, 3> by_v{};  // v_mean, v_s, v_c
};

Memory after_positive(const SlipFunctions& w, double k_u, double mu_k_v) {
  const Direction& e = w.end_of_positive;
  return {.value = w.limit - w.positive,
          .by_u = {-k_u * e.sin, -k_u * e.cos},
          .by_v = {mu_k_v, mu_k_v * e.sin, mu_k_v * e.cos}};
}

Memory after_negative(const SlipFunctions& w, double k_u, double mu_k_v) {
  const Direction& e = w.end_of_negative;
  return {.value = w.negative - w.limit,
          .by_u = {-k_u * e.sin, -k_u * e.cos},
          .by_v = {-mu_k_v, -mu_k_v * e.sin, -mu_k_v * e.cos}};
}

// The instant of touch-down moves with the load; a point that sticks there has
// |k_u u̇| ≤ μ k_v v̇, so the quotient is bounded even where v̇ vanishes.
Memory after_separation(const Direction& touch_down, const PointMotion& m, double k_u,
                        double mu_k_v) {
  const double u = m.u_sin * touch_down.sin + m.u_cos * touch_down.cos;
  const double u_rate = m.u_sin * touch_down.cos - m.u_cos * touch_down.sin;
  const double v_rate = m.v_sin * touch_down.cos - m.v_cos * touch_down.sin;
  const double quotient = v_rate > 0.0 ? std::clamp(k_u * (u_rate / v_rate), -mu_k_v, mu_k_v) : 0.0;
  return {.value = -k_u * u,
          .by_u = {-k_u * touch_down.sin, -k_u * touch_down.cos},
          .by_v = {quotient, quotient * touch_down.sin, quotient * touch_down.cos}};
}

// Adds what a coefficient with weights `row` = (∫k, ∫k sin, ∫k cos) / norm gets.
using Row = std::array<double, 3>;

std::array<Row, 3> rows(const Integrals& i) {
  constexpr double mean = 0.5 / pi;
  constexpr double wave = 1.0 / pi;
  return {Row{mean * i.one, mean * i.sin, mean * i.cos},
          Row{wave * i.sin, wave * i.sin_sin, wave * i.sin_cos},
          Row{wave * i.cos, wave * i.sin_cos, wave * i.cos_cos}};
}

void set(ForceCoefficients& force, const Row& values) { force = {values[0], values[1], values[2]}; }

void set_normal(CycleForce& force, const SlipFunctions& w, const PointParameters& point,
                const PointMotion& m, const Integrals& contact) {
  const double k_v = point.normal_stiffness;
  const std::array<Row, 3> r = rows(contact);
  Row n{};
  for (std::size_t k = 0; k < 3; ++k) {
    n[k] = w.mean_load * r[k][0] + k_v * m.v_sin * r[k][1] + k_v * m.v_cos * r[k][2];
    force.normal_by_v[k] = {k_v * r[k][0], k_v * r[k][1], k_v * r[k][2]};
  }
  set(force.normal, n);
}

// In contact throughout: the load is its own Fourier series.
void set_whole_normal(CycleForce& force, const SlipFunctions& w, const PointParameters& point,
                      const PointMotion& m) {
  const double k_v = point.normal_stiffness;
  force.normal = {w.mean_load, k_v * m.v_sin, k_v * m.v_cos};
  for (std::size_t k = 0; k < 3; ++k) {
    force.normal_by_v[k][k] = k_v;
  }
}

void add_memory(CycleForce& force, Row& f, const Memory& memory, const Integrals& stick) {
  const Row r{0.5 / pi * stick.one, stick.sin / pi, stick.cos / pi};
  for (std::size_t k = 0; k < 3; ++k) {
    f[k] += memory.value * r[k];
    force.friction_by_u[k][0] += memory.by_u[0] * r[k];
    force.friction_by_u[k][1] += memory.by_u[1] * r[k];
    force.friction_by_v[k][0] += memory.by_v[0] * r[k];
    force.friction_by_v[k][1] += memory.by_v[1] * r[k];
    force.friction_by_v[k][2] += memory.by_v[2] * r[k];
  }
}

void set_friction(CycleForce& force, const SlipFunctions& w, const PointParameters& point,
                  const PointMotion& m, const CyclePhases& phases) {
  const PhaseSums sums = phase_sums(phases);
  const double k_u = point.tangential_stiffness;
  const double mu_k_v = point.friction_coefficient * point.normal_stiffness;
  const Integrals& after_e = sums[PhaseKind::stick_after_separation];
  const Integrals& after_p = sums[PhaseKind::stick_after_positive];
  const Integrals& after_n = sums[PhaseKind::stick_after_negative];
  Integrals stick = after_e;
  stick += after_p;
  stick += after_n;
  const std::array<Row, 3> s = rows(stick);
  const std::array<Row, 3> d =
      rows(difference(sums[PhaseKind::positive_slip], sums[PhaseKind::negative_slip]));
  Row f{};
  for (std::size_t k = 0; k < 3; ++k) {
    f[k] = w.limit * d[k][0] + mu_k_v * m.v_sin * d[k][1] + mu_k_v * m.v_cos * d[k][2] +
           k_u * m.u_sin * s[k][1] + k_u * m.u_cos * s[k][2];
    force.friction_by_u[k] = {k_u * s[k][1], k_u * s[k][2]};
    force.friction_by_v[k] = {mu_k_v * d[k][0], mu_k_v * d[k][1], mu_k_v * d[k][2]};
  }
  add_memory(force, f, after_positive(w, k_u, mu_k_v), after_p);
  add_memory(force, f, after_negative(w, k_u, mu_k_v), after_n);
  if (after_e.one > 0.0) {
    add_memory(force, f, after_separation(phases.phase[0].begin, m, k_u, mu_k_v), after_e);
  }
  set(force.friction, f);
}

// (2): which end of the admissible band holds the offset, if any.
void set_full_stick(CycleForce& force, const SlipFunctions& w, const PointParameters& point,
                    const PointMotion& m) {
  const double k_u = point.tangential_stiffness;
  const double mu_k_v = point.friction_coefficient * point.normal_stiffness;
  const Memory low = after_negative(w, k_u, mu_k_v);
  const Memory high = after_positive(w, k_u, mu_k_v);
  Memory offset{.value = k_u * m.u_mean};
  force.mean_by_u_mean = k_u;
  if (offset.value < low.value || offset.value > high.value) {
    offset = offset.value < low.value ? low : high;
    force.mean_by_u_mean = 0.0;
  }
  force.friction = {offset.value, k_u * m.u_sin, k_u * m.u_cos};
  force.friction_by_u = {{{offset.by_u[0], offset.by_u[1]}, {k_u, 0.0}, {0.0, k_u}}};
  force.friction_by_v[0] = offset.by_v;
}

bool frictionless(const PointParameters& point) {
  return point.tangential_stiffness == 0.0 || point.friction_coefficient == 0.0;
}

}  // namespace

CycleForce cycle_force(const PointParameters& point, const PointMotion& motion,
                       const SlipFunctions& w, CycleRegime regime, const CyclePhases& phases) {
  CycleForce force;
  force.regime = regime;
  if (regime == CycleRegime::separated) {
    return force;
  }
  if (regime == CycleRegime::separation) {
    set_normal(force, w, point, motion, contact_integrals(phases));
  } else {
    set_whole_normal(force, w, point, motion);
  }
  if (frictionless(point)) {
    return force;
  }
  if (regime == CycleRegime::full_stick) {
    set_full_stick(force, w, point, motion);
  } else {
    set_friction(force, w, point, motion, phases);
  }
  return force;
}

}  // namespace microslip::contact
