#include "contact/closed_form/slip_energy.hpp"

#include <algorithm>
#include <cmath>

namespace microslip::contact {
namespace {

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

struct SlipPhase {
  double size;      // L
  double mean;      // n₀
  double in_phase;  // k_v v at the extremum
  double rate;      // k_v v̇ there

  // ∫ n L sin x dx, x from `last` to `last` + length, about the middle of the phase.
  [[nodiscard]] double work(double last, double length) const {
    const double h = 0.5 * length;
    const double sine = std::sin(last + h);
    const double cosine = std::cos(last + h);
    const double swing = in_phase * cosine - rate * sine;  // A
    const double slope = in_phase * sine + rate * cosine;  // S
    const double half = std::sin(0.5 * h);
    const double square = x_minus_sin_cos(h);  // ∫ sin²y
    const double versed =                      // ∫ (1 − cos y) cos y
        2.0 * half * half * std::sin(h) - 2.0 * x_minus_sin_cos(0.5 * h);
    return size *
           (sine * (2.0 * (mean + swing) * std::sin(h) - swing * versed) - slope * cosine * square);
  }
};

// A slider is pushed towards the point and never past it: a phase of slip is no longer than the way
// of the point, and its load no larger than the largest. Where u is next to nothing beside μn, the
// lengths of phases round to more.
void bound(SlipEnergy& energy, int n_phases, const PointMotion& m, const SlipFunctions& w) {
  constexpr double rounding = 1.0 + 1e-14;  // of distances that are this long
  const double way = 2.0 * rounding * std::hypot(m.u_sin, m.u_cos);
  energy.distance = std::min(energy.distance, n_phases * way);
  energy.normal_slip = std::min(energy.normal_slip, n_phases * way * std::max(w.above_open, 0.0));
}

SlipPhase slip_towards(bool positive, const PointParameters& point, const PointMotion& m,
                       const SlipFunctions& w) {
  const Direction& e = positive ? w.end_of_positive : w.end_of_negative;
  const double k_v = point.normal_stiffness;
  return {.size = positive ? w.positive : w.negative,
          .mean = w.bias_load,
          .in_phase = k_v * (m.v_sin * e.sin + m.v_cos * e.cos),
          .rate = k_v * (m.v_sin * e.cos - m.v_cos * e.sin)};
}

}  // namespace

SlipEnergy slip_energy(const PointParameters& point, const PointMotion& motion,
                       const SlipFunctions& w, const CyclePhases& phases) {
  const double k_u = point.tangential_stiffness;
  SlipEnergy energy;
  int n_slip_phases = 0;
  for (int i = 0; i < phases.n_phases; ++i) {
    const CyclePhase& phase = phases.phase[static_cast<std::size_t>(i)];
    const bool positive = phase.kind == PhaseKind::positive_slip;
    if (!positive && phase.kind != PhaseKind::negative_slip) {
      continue;
    }
    ++n_slip_phases;
    const SlipPhase slip = slip_towards(positive, point, motion, w);
    const double first = phase.to_extremum;
    const double length = std::min(phase.length, first);
    const double last = first - length;
    energy.normal_slip += std::max(slip.work(last, length) / k_u, 0.0);
    energy.distance +=
        2.0 * slip.size * std::sin(last + 0.5 * length) * std::sin(0.5 * length) / k_u;
  }
  bound(energy, n_slip_phases, motion, w);
  return energy;
}

}  // namespace microslip::contact
