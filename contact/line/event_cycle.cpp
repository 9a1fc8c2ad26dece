#include "contact/line/event_cycle.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "contact/point/cycle_segments.hpp"

namespace microslip::contact {
namespace {

// As short as the rounding of its angles, a few units in the last place of 2π: none.
constexpr double shortest = 4e-15;

// Gauss–Legendre on [−1, 1], exact for polynomials of degree 15.
constexpr std::array<double, 4> nodes{0.18343464249564980494, 0.52553240991632898582,
                                      0.79666647741362673959, 0.96028985649753623168};
constexpr std::array<double, 4> weights{0.36268378337836198297, 0.31370664587788728734,
                                        0.22238103445337447054, 0.10122853629037625915};

// ∫ n |dw/dθ| over one slip phase of the given rate.
double slip_integral(const EventGuards& guards, const TrigonometricPolynomial& rate,
                     const EventPhase& phase) {
  // On a piece of a quarter radian of the highest product the rule errs by 1e-17 of the integral.
  const double fineness = 4.0 * 2.0 * std::max(guards.load.degree(), 1);
  const int pieces = 1 + static_cast<int>(phase.length * fineness / 2.0);
  const double half = 0.5 * phase.length / pieces;
  double sum = 0.0;
  for (int piece = 0; piece < pieces; ++piece) {
    const double middle = phase.begin + (2 * piece + 1) * half;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      for (const double at : {middle - half * nodes[i], middle + half * nodes[i]}) {
        sum += weights[i] * half * std::max(guards.load.value(at), 0.0) * std::abs(rate.value(at));
      }
    }
  }
  return sum;
}

}  // namespace

std::vector<CycleSegment> event_segments(const PointParameters& point, const EventPhases& phases) {
  const bool has_spring = point.tangential_stiffness > 0.0;
  std::vector<CycleSegment> segments;
  for (const EventPhase& phase : phases.phases) {
    CycleSegment segment{phase.state, phase.begin, phase.length, phase.offset};
    if (!has_spring && segment.state != ContactState::separated) {
      segment.state = ContactState::stick;
    }
    if (segment.state != ContactState::stick || !point.rubs()) {
      segment.offset = 0.0;
    }
    segments.push_back(segment);
  }
  return joined_segments(segments, shortest);
}

const CycleSegment& segment_at(const std::vector<CycleSegment>& segments, double phase) {
  const double now = wrapped_phase(phase);
  const auto after = std::find_if(segments.begin(), segments.end(),
                                  [&](const CycleSegment& s) { return s.start > now; });
  return after == segments.begin() ? segments.back() : *std::prev(after);
}

EventWork event_work(const PointParameters& point, const EventGuards& guards,
                     const EventPhases& phases) {
  EventWork work;
  if (point.tangential_stiffness == 0.0) {
    return work;
  }
  for (const EventPhase& phase : phases.phases) {
    const bool up = phase.state == ContactState::positive_slip;
    if (!up && phase.state != ContactState::negative_slip) {
      continue;
    }
    const TrigonometricPolynomial& w = up ? guards.positive : guards.negative;
    const TrigonometricPolynomial& rate = up ? guards.positive_rate : guards.negative_rate;
    const double moved = w.value(phase.begin + phase.length) - w.value(phase.begin);
    work.slip_distance += std::max(up ? moved : -moved, 0.0);
    work.normal_slip += slip_integral(guards, rate, phase);
  }
  work.slip_distance /= point.tangential_stiffness;
  work.normal_slip /= point.tangential_stiffness;
  return work;
}

PointInstant event_instant(const PointParameters& point, const Harmonics& motion,
                           const CycleSegment& segment, double phase) {
  const double k_u = point.tangential_stiffness;
  PointInstant now;
  now.state = segment.state;
  now.motion = motion.at(phase);
  const double load = std::max(0.0, point.rest_load + point.normal_stiffness * now.motion[1]);
  const double limit = point.friction_coefficient * load;
  double friction = 0.0;
  if (segment.state == ContactState::positive_slip) {
    friction = limit;
  } else if (segment.state == ContactState::negative_slip) {
    friction = -limit;
  } else if (segment.state == ContactState::stick) {
    const double moving = now.motion[0] - motion.rows()(0, 0);
    friction = std::clamp(k_u * moving + segment.offset, -limit, limit);
  }
  now.traction = {friction, segment.state == ContactState::separated ? 0.0 : load, 0.0};
  const double deflection = k_u > 0.0 ? friction / k_u : 0.0;
  now.slider = {k_u > 0.0 ? now.motion[0] - deflection : 0.0, now.motion[2]};
  return now;
}

}  // namespace microslip::contact
