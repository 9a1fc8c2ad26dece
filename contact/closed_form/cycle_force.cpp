#include "contact/closed_form/cycle_force.hpp"

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

// A force offset c that is frozen during full stick, and its derivatives (theory section 6).
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
    n[k] = w.bias_load * r[k][0] + k_v * m.v_sin * r[k][1] + k_v * m.v_cos * r[k][2];
    force.normal_by_v[k] = {k_v * r[k][0], k_v * r[k][1], k_v * r[k][2]};
  }
  set(force.normal, n);
}

// In contact throughout: the load is its own Fourier series.
void set_whole_normal(CycleForce& force, const SlipFunctions& w, const PointParameters& point,
                      const PointMotion& m) {
  const double k_v = point.normal_stiffness;
  force.normal = {w.bias_load, k_v * m.v_sin, k_v * m.v_cos};
  for (std::size_t k = 0; k < 3; ++k) {
    force.normal_by_v[k][k] = k_v;
  }
}

// x − sin x and 1 − cos x without cancellation below a quarter, with sin x and cos x at hand
// beyond.
constexpr double short_angle = 0.25;

double angle_minus_sine(double x, double sine) {
  if (x > short_angle) return x - sine;
  const double z = x * x;
  return x * z / 6.0 * (1.0 - z / 20.0 * (1.0 - z / 42.0 * (1.0 - z / 72.0 * (1.0 - z / 110.0))));
}

double one_minus_cosine(double x, double cosine) {
  if (x > short_angle) return 1.0 - cosine;
  const double z = x * x;
  return 0.5 * z * (1.0 - z / 12.0 * (1.0 - z / 30.0 * (1.0 - z / 56.0 * (1.0 - z / 90.0))));
}

// Weighted integrals over a stick phase of sin x and 1 − cos x, x the angle since it began at θ_e:
// with them sin θ − sin θ_e = cos θ_e sin x − sin θ_e (1 − cos x), and nothing cancels in short
// phases.
struct StickRows {
  Row sine;    // ∫ sin x · (1/2π, sin θ/π, cos θ/π)
  Row versed;  // ∫ (1 − cos x) · …
};

Row turned(const Direction& e, double one, double by_cos, double by_sin) {
  return {0.5 / pi * one, (e.sin * by_cos + e.cos * by_sin) / pi,
          (e.cos * by_cos - e.sin * by_sin) / pi};
}

StickRows stick_rows(const CyclePhase& phase, const Direction& end) {
  const Direction& e = phase.begin;
  const double x = phase.length;
  const double full_cosine = e.cos * end.cos + e.sin * end.sin;
  const double versed = one_minus_cosine(x, full_cosine);
  const double rest = angle_minus_sine(x, e.cos * end.sin - e.sin * end.cos);
  const double sine = x - rest;
  // ∫ sin²x = (2x − sin 2x)/4
  const double square = 0.25 * angle_minus_sine(2.0 * x, 2.0 * sine * (1.0 - versed));
  return {.sine = turned(e, versed, 0.5 * sine * sine, square),
          .versed = turned(e, rest, square - rest, 0.5 * versed * versed)};
}

// Adds what a stick phase has beyond the friction ± μn it follows: −L₁ (1 − cos x) after positive
// slip, L₂ (1 − cos x) after negative slip; that friction is in the sums of the slip phases.
void add_stick(CycleForce& force, Row& f, const StickRows& rows, const Direction& e, double size,
               double k_u, double mu_k_v) {
  for (std::size_t k = 0; k < 3; ++k) {
    const double by_sin = e.cos * rows.sine[k] - e.sin * rows.versed[k];  // ∫ sin θ − sin θ_e
    const double by_cos = -e.sin * rows.sine[k] - e.cos * rows.versed[k];  // ∫ cos θ − cos θ_e
    f[k] += size * rows.versed[k];
    force.friction_by_u[k][0] += k_u * by_sin;
    force.friction_by_u[k][1] += k_u * by_cos;
    force.friction_by_v[k][1] += mu_k_v * by_sin;
    force.friction_by_v[k][2] += mu_k_v * by_cos;
  }
}

// f = k_u [u(θ) − u(θ₂)]. The instant of touch-down θ₂ moves with the load; a point that sticks
// there has |k_u u̇| ≤ μ k_v v̇, so the quotient is bounded even where v̇ vanishes.
void add_stick_after_separation(CycleForce& force, Row& f, const StickRows& rows,
                                const PointMotion& m, const Direction& touch_down,
                                const Integrals& stick, double k_u, double mu_k_v) {
  const Direction& e = touch_down;
  const double u = m.u_sin * e.sin + m.u_cos * e.cos;
  const double u_rate = m.u_sin * e.cos - m.u_cos * e.sin;
  const double v_rate = m.v_sin * e.cos - m.v_cos * e.sin;
  const double quotient = v_rate > 0.0 ? std::clamp(k_u * (u_rate / v_rate), -mu_k_v, mu_k_v) : 0.0;
  const Row one{0.5 / pi * stick.one, stick.sin / pi, stick.cos / pi};
  for (std::size_t k = 0; k < 3; ++k) {
    f[k] += k_u * (u_rate * rows.sine[k] - u * rows.versed[k]);
    force.friction_by_u[k][0] += k_u * (e.cos * rows.sine[k] - e.sin * rows.versed[k]);
    force.friction_by_u[k][1] += k_u * (-e.sin * rows.sine[k] - e.cos * rows.versed[k]);
    force.friction_by_v[k][0] += quotient * one[k];
    force.friction_by_v[k][1] += quotient * e.sin * one[k];
    force.friction_by_v[k][2] += quotient * e.cos * one[k];
  }
}

// Slip phases, and the friction of slip that a stick phase continues, by their integrals.
void set_slip(CycleForce& force, Row& f, const SlipFunctions& w, const PointMotion& m,
              double mu_k_v, const PhaseSums& sums) {
  Integrals positive = sums[PhaseKind::positive_slip];
  positive += sums[PhaseKind::stick_after_positive];
  Integrals negative = sums[PhaseKind::negative_slip];
  negative += sums[PhaseKind::stick_after_negative];
  const std::array<Row, 3> d = rows(difference(positive, negative));
  for (std::size_t k = 0; k < 3; ++k) {
    f[k] = w.limit * d[k][0] + mu_k_v * m.v_sin * d[k][1] + mu_k_v * m.v_cos * d[k][2];
    force.friction_by_v[k] = {mu_k_v * d[k][0], mu_k_v * d[k][1], mu_k_v * d[k][2]};
  }
}

void set_friction(CycleForce& force, const SlipFunctions& w, const PointParameters& point,
                  const PointMotion& m, const CyclePhases& phases) {
  const PhaseSums sums = phase_sums(phases);
  const double k_u = point.tangential_stiffness;
  const double mu_k_v = point.friction_coefficient * point.normal_stiffness;
  Row f{};
  set_slip(force, f, w, m, mu_k_v, sums);
  for (int i = 0; i < phases.n_phases; ++i) {
    const CyclePhase& phase = phases.phase[static_cast<std::size_t>(i)];
    const bool after_positive = phase.kind == PhaseKind::stick_after_positive;
    const bool after_negative = phase.kind == PhaseKind::stick_after_negative;
    const bool after_separation = phase.kind == PhaseKind::stick_after_separation;
    if (!after_positive && !after_negative && !after_separation) continue;
    const int next = i + 1 < phases.n_phases ? i + 1 : 0;
    const StickRows stick = stick_rows(phase, phases.phase[static_cast<std::size_t>(next)].begin);
    if (after_separation) {
      add_stick_after_separation(force, f, stick, m, phase.begin, sums[phase.kind], k_u, mu_k_v);
    } else {
      add_stick(force, f, stick, phase.begin, after_positive ? -w.positive : w.negative, k_u,
                after_positive ? -mu_k_v : mu_k_v);
    }
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
  if (!point.rubs()) {
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
