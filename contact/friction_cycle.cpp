#include "contact/friction_cycle.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "contact/cycle_phases.hpp"
#include "contact/slip_functions.hpp"

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
                  const PointMotion& m, const CyclePhases& phases, const PhaseSums& sums) {
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

// What both public functions share: the phases and the force.
struct Solution {
  SlipFunctions w;
  CycleRegime regime = CycleRegime::separated;
  CyclePhases phases;  // with slip or separation
  CycleForce force;
};

Solution solve(const PointParameters& point, const PointMotion& motion) {
  Solution solution;
  solution.w = slip_functions(point, motion);
  const SlipFunctions& w = solution.w;
  solution.regime = cycle_regime(w);
  if (solution.regime == CycleRegime::separated) {
    return solution;
  }
  if (solution.regime == CycleRegime::separation) {
    solution.phases = separation_phases(w);
  } else {
    set_whole_normal(solution.force, w, point, motion);
    if (solution.regime == CycleRegime::full_stick) {
      if (!frictionless(point)) {
        set_full_stick(solution.force, w, point, motion);
      }
      return solution;
    }
    solution.phases = stick_slip_phases(w);
  }
  const PhaseSums sums = phase_sums(solution.phases);
  if (solution.regime == CycleRegime::separation) {
    Integrals contact;
    for (std::size_t k = 1; k < sums.by_kind.size(); ++k) {
      contact += sums.by_kind[k];
    }
    set_normal(solution.force, w, point, motion, contact);
  }
  if (!frictionless(point)) {
    set_friction(solution.force, w, point, motion, solution.phases, sums);
  }
  return solution;
}

// --- energies -----------------------------------------------------------------------------------

// x − sin x cos x without cancellation for small x: (2x)³/12 − (2x)⁵/240 + …
double x_minus_sin_cos(double x) {
  const double y = 2.0 * x;
  if (y > 0.5) {
    return 0.5 * (y - std::sin(y));
  }
  const double z = y * y;
  return y * z / 12.0 *
         (1.0 -
          z / 20.0 * (1.0 - z / 42.0 * (1.0 - z / 72.0 * (1.0 - z / 110.0 * (1.0 - z / 156.0)))));
}

// Slip towards one extremum: rate L sin x / k_u, x the angle that remains.
struct SlipPhase {
  double size;      // L
  double mean;      // n₀
  double in_phase;  // k_v v at the extremum
  double rate;      // k_v v̇ there

  // ∫ n L sin x dx from 0 to x
  double work(double x) const {
    const double half = std::sin(0.5 * x);
    const double sine = std::sin(x);
    return size * (mean * 2.0 * half * half + 0.5 * in_phase * sine * sine -
                   0.5 * rate * x_minus_sin_cos(x));
  }
};

void add_slip(FrictionCycle& cycle, const CyclePhase& phase, const SlipFunctions& w,
              const PointParameters& point, const PointMotion& m) {
  const bool positive = phase.kind == PhaseKind::positive_slip;
  const Direction& e = positive ? w.end_of_positive : w.end_of_negative;
  const double k_u = point.tangential_stiffness;
  const double k_v = point.normal_stiffness;
  const SlipPhase slip{.size = positive ? w.positive : w.negative,
                       .mean = w.mean_load,
                       .in_phase = k_v * (m.v_sin * e.sin + m.v_cos * e.cos),
                       .rate = k_v * (m.v_sin * e.cos - m.v_cos * e.sin)};
  const double first = phase.to_extremum;
  const double last = std::max(first - phase.length, 0.0);
  const double work = (slip.work(first) - slip.work(last)) / k_u;
  cycle.normal_slip += std::max(work, 0.0);
  cycle.slip_distance +=
      2.0 * slip.size * std::sin(0.5 * (first + last)) * std::sin(0.5 * (first - last)) / k_u;
}

// --- segments -----------------------------------------------------------------------------------

ContactState state_of(PhaseKind kind) {
  switch (kind) {
    case PhaseKind::separated:
      return ContactState::separated;
    case PhaseKind::positive_slip:
      return ContactState::positive_slip;
    case PhaseKind::negative_slip:
      return ContactState::negative_slip;
    default:
      return ContactState::stick;
  }
}

double start_angle(const Direction& d) {
  const double a = std::atan2(d.sin, d.cos);
  const double wrapped = a < 0.0 ? a + 2.0 * pi : a;
  return wrapped < 2.0 * pi ? wrapped : 0.0;
}

void add_segment(FrictionCycle& cycle, const CycleSegment& segment) {
  if (segment.length <= 0.0) {
    return;
  }
  if (cycle.n_segments_ > 0 && cycle.segment_[cycle.n_segments_ - 1].state == segment.state) {
    cycle.segment_[cycle.n_segments_ - 1].length += segment.length;
  } else {
    cycle.segment_[cycle.n_segments_++] = segment;
  }
}

// Neighbours of the same state become one, also across the end of the list; the earliest start
// first.
void finish_segments(FrictionCycle& cycle) {
  const auto begin = cycle.segment_.begin();
  std::size_t& n = cycle.n_segments_;
  if (n > 1 && begin[0].state == cycle.segment_[n - 1].state) {
    cycle.segment_[n - 1].length += begin[0].length;
    std::move(begin + 1, begin + static_cast<std::ptrdiff_t>(n), begin);
    --n;
  }
  const auto end = begin + static_cast<std::ptrdiff_t>(n);
  std::rotate(begin,
              std::min_element(
                  begin, end,
                  [](const CycleSegment& a, const CycleSegment& b) { return a.start < b.start; }),
              end);
}

double stick_offset(const CyclePhase& phase, const SlipFunctions& w, const PointParameters& point,
                    const PointMotion& m) {
  switch (phase.kind) {
    case PhaseKind::stick_after_positive:
      return w.limit - w.positive;
    case PhaseKind::stick_after_negative:
      return w.negative - w.limit;
    case PhaseKind::stick_after_separation:
      return -point.tangential_stiffness * (m.u_sin * phase.begin.sin + m.u_cos * phase.begin.cos);
    default:
      return 0.0;
  }
}

void set_segments(FrictionCycle& cycle, const Solution& solution, const PointParameters& point,
                  const PointMotion& m) {
  for (int i = 0; i < solution.phases.n_phases; ++i) {
    const CyclePhase& phase = solution.phases.phase[static_cast<std::size_t>(i)];
    CycleSegment segment{state_of(phase.kind), start_angle(phase.begin), phase.length,
                         stick_offset(phase, solution.w, point, m)};
    if (point.tangential_stiffness == 0.0) {
      segment.offset = 0.0;
      if (segment.state != ContactState::separated) {
        segment.state = ContactState::stick;
      }
    }
    add_segment(cycle, segment);
  }
  finish_segments(cycle);
}

// The segment that covers θ: the last one that has started, or the one that runs through 0.
const CycleSegment& segment_at(const FrictionCycle& cycle, double phase) {
  const double turn = phase - 2.0 * pi * std::floor(phase / (2.0 * pi));
  const auto segments = cycle.segments();
  const CycleSegment* found = &segments.back();
  for (const CycleSegment& segment : segments) {
    if (segment.start <= turn) {
      found = &segment;
    }
  }
  return *found;
}

CycleJacobian jacobian(const CycleForce& force) {
  CycleJacobian J = CycleJacobian::Zero();
  J(0, 0) = force.mean_by_u_mean;
  for (std::size_t row = 0; row < 3; ++row) {
    const auto i = static_cast<Eigen::Index>(row);
    for (std::size_t column = 0; column < 3; ++column) {
      const auto j = static_cast<Eigen::Index>(column);
      if (column < 2) {
        J(i, 1 + j) = force.friction_by_u[row][column];
      }
      J(i, 3 + j) = force.friction_by_v[row][column];
      J(3 + i, 3 + j) = force.normal_by_v[row][column];
    }
  }
  return J;
}

// --- subnormal forces ---------------------------------------------------------------------------

// The cycle is homogeneous of degree one in motion and preload. Where its forces would be subnormal
// numbers it is solved at a larger amplitude, by a power of two, and the forces taken back.
constexpr double lift = 0x1p500;

bool is_tiny(const PointParameters& point, const PointMotion& m) {
  const double u = std::abs(m.u_mean) + std::abs(m.u_sin) + std::abs(m.u_cos);
  const double v = std::abs(m.v_mean) + std::abs(m.v_sin) + std::abs(m.v_cos);
  const double size =
      point.tangential_stiffness * u + point.normal_stiffness * v + std::abs(point.preload);
  return size < 1e-250 && (u > 0.0 || v > 0.0 || point.preload != 0.0) && u < 1e100 && v < 1e100;
}

PointParameters lifted(PointParameters point) {
  point.preload *= lift;
  return point;
}

PointMotion lifted(const PointMotion& m) {
  return {m.u_mean * lift, m.u_sin * lift, m.u_cos * lift,
          m.v_mean * lift, m.v_sin * lift, m.v_cos * lift};
}

ForceCoefficients lowered(const ForceCoefficients& force) {
  return {force.mean / lift, force.sin / lift, force.cos / lift};
}

}  // namespace

CycleForce cycle_force(const PointParameters& point, const PointMotion& motion) {
  if (is_tiny(point, motion)) {
    CycleForce force = solve(lifted(point), lifted(motion)).force;
    force.friction = lowered(force.friction);
    force.normal = lowered(force.normal);
    return force;
  }
  return solve(point, motion).force;
}

FrictionCycle friction_cycle(const PointParameters& point, const PointMotion& motion) {
  if (is_tiny(point, motion)) {
    FrictionCycle cycle = friction_cycle(lifted(point), lifted(motion));
    cycle.friction = lowered(cycle.friction);
    cycle.normal = lowered(cycle.normal);
    for (CycleSegment& segment : cycle.segment_) {
      segment.offset /= lift;
    }
    cycle.slip_distance /= lift;
    cycle.normal_slip = cycle.normal_slip / lift / lift;
    cycle.dissipated_energy = cycle.dissipated_energy / lift / lift;
    return cycle;
  }
  const Solution solution = solve(point, motion);
  FrictionCycle cycle;
  cycle.regime = solution.regime;
  cycle.friction = solution.force.friction;
  cycle.normal = solution.force.normal;
  cycle.jacobian = jacobian(solution.force);
  const bool slips = point.tangential_stiffness > 0.0;
  if (solution.phases.n_phases == 0) {
    const bool stuck = solution.regime == CycleRegime::full_stick;
    add_segment(cycle, {stuck ? ContactState::stick : ContactState::separated, 0.0, 2.0 * pi,
                        cycle.friction.mean});
    return cycle;
  }
  set_segments(cycle, solution, point, motion);
  for (int i = 0; slips && i < solution.phases.n_phases; ++i) {
    const CyclePhase& phase = solution.phases.phase[static_cast<std::size_t>(i)];
    if (phase.kind == PhaseKind::positive_slip || phase.kind == PhaseKind::negative_slip) {
      add_slip(cycle, phase, solution.w, point, motion);
    }
  }
  cycle.dissipated_energy = point.friction_coefficient * cycle.normal_slip;
  return cycle;
}

CycleInstant at_phase(const FrictionCycle& cycle, const PointParameters& point,
                      const PointMotion& motion, double phase) {
  const double sin = std::sin(phase);
  const double cos = std::cos(phase);
  const double moving = motion.u_sin * sin + motion.u_cos * cos;
  CycleInstant now{.u = motion.u_mean + moving,
                   .v = motion.v_mean + motion.v_sin * sin + motion.v_cos * cos};
  now.normal = std::max(0.0, point.preload + point.normal_stiffness * now.v);
  const CycleSegment& segment = segment_at(cycle, phase);
  now.state = segment.state;
  const double limit = point.friction_coefficient * now.normal;
  switch (segment.state) {
    case ContactState::positive_slip:
      now.friction = limit;
      break;
    case ContactState::negative_slip:
      now.friction = -limit;
      break;
    case ContactState::stick:
      now.friction =
          std::clamp(point.tangential_stiffness * moving + segment.offset, -limit, limit);
      break;
    default:
      now.normal = 0.0;
  }
  if (point.tangential_stiffness > 0.0) {
    now.slider = now.u - now.friction / point.tangential_stiffness;
  }
  return now;
}

}  // namespace microslip::contact
