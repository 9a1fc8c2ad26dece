#include "contact/closed_form/friction_cycle.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "contact/closed_form/cycle_force.hpp"
#include "contact/closed_form/cycle_phases.hpp"
#include "contact/closed_form/slip_energy.hpp"
#include "contact/closed_form/slip_functions.hpp"

namespace microslip::contact {
namespace {

constexpr double pi = std::numbers::pi;

double start_angle(const Direction& d) {
  const double a = std::atan2(d.sin, d.cos);
  const double wrapped = a < 0.0 ? a + 2.0 * pi : a;
  return wrapped < 2.0 * pi ? wrapped : 0.0;
}

// A segment as short as the rounding of its angles, a few units in the last place of 2π, is none;
// its length goes to the one before it.
void add_segment(FrictionCycle& cycle, const CycleSegment& segment) {
  constexpr double shortest = 4e-15;
  const std::size_t n = cycle.n_segments_;
  if (n > 0 && (cycle.segment_[n - 1].state == segment.state || segment.length < shortest)) {
    cycle.segment_[n - 1].length += segment.length;
  } else if (segment.length >= shortest) {
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

void set_segments(FrictionCycle& cycle, const SlipFunctions& w, const CyclePhases& phases,
                  const PointParameters& point, const PointMotion& m) {
  for (int i = 0; i < phases.n_phases; ++i) {
    const CyclePhase& phase = phases.phase[static_cast<std::size_t>(i)];
    CycleSegment segment{state_of(phase.kind), start_angle(phase.begin), phase.length,
                         stick_offset(phase, w, point, m)};
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

}  // namespace

FrictionCycle friction_cycle(const PointParameters& point, const PointMotion& motion) {
  const SlipFunctions w = slip_functions(point, motion);
  const CycleRegime regime = cycle_regime(w);
  const CyclePhases phases = cycle_phases(w, regime);
  const CycleForce force = cycle_force(point, motion, w, regime, phases);
  FrictionCycle cycle;
  cycle.regime = regime;
  cycle.friction = force.friction;
  cycle.normal = force.normal;
  cycle.jacobian = jacobian(force);
  if (phases.n_phases == 0) {
    const bool stuck = regime == CycleRegime::full_stick;
    add_segment(cycle, {stuck ? ContactState::stick : ContactState::separated, 0.0, 2.0 * pi,
                        cycle.friction.mean});
    return cycle;
  }
  set_segments(cycle, w, phases, point, motion);
  if (point.tangential_stiffness > 0.0) {
    const SlipEnergy energy = slip_energy(point, motion, w, phases);
    cycle.normal_slip = energy.normal_slip;
    cycle.slip_distance = energy.distance;
    cycle.dissipated_energy = point.friction_coefficient * energy.normal_slip;
  }
  return cycle;
}

CycleInstant at_phase(const FrictionCycle& cycle, const PointParameters& point,
                      const PointMotion& motion, double phase) {
  const double sin = std::sin(phase);
  const double cos = std::cos(phase);
  const double moving = motion.u_sin * sin + motion.u_cos * cos;
  CycleInstant now{.u = motion.u_mean + moving,
                   .v = motion.v_mean + motion.v_sin * sin + motion.v_cos * cos};
  now.normal = std::max(0.0, point.rest_load + point.normal_stiffness * now.v);
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
