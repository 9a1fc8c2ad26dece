#include "pipelines/cycle_harmonics.hpp"

#include <cmath>
#include <numbers>

namespace microslip::pipelines {
namespace {

using contact::ContactState;

/// A + B sin θ + C cos θ.
struct Wave {
  double A = 0.0;
  double B = 0.0;
  double C = 0.0;
};

struct Integrals {
  double sin = 0.0;
  double cos = 0.0;
};

/// ∫ sin jθ dθ and ∫ cos jθ dθ over a segment, j ≥ 1; no cancellation for short segments.
Integrals integrals(double j, const contact::CycleSegment& segment) {
  const double middle = segment.start + 0.5 * segment.length;
  const double width = 2.0 * std::sin(0.5 * j * segment.length) / j;
  return {width * std::sin(j * middle), width * std::cos(j * middle)};
}

/// ∫ (A + B sin θ + C cos θ) sin hθ dθ and the same with cos hθ, h ≥ 2.
Integrals project(const Wave& wave, int h, const contact::CycleSegment& segment) {
  const Integrals at = integrals(h, segment);
  const Integrals below = integrals(h - 1, segment);
  const Integrals above = integrals(h + 1, segment);
  return {wave.A * at.sin + 0.5 * wave.B * (below.cos - above.cos) +
              0.5 * wave.C * (above.sin + below.sin),
          wave.A * at.cos + 0.5 * wave.B * (above.sin - below.sin) +
              0.5 * wave.C * (above.cos + below.cos)};
}

Wave normal_wave(const contact::PointParameters& point, const contact::PointMotion& motion) {
  const double k = point.normal_stiffness;
  return {point.preload + k * motion.v_mean, k * motion.v_sin, k * motion.v_cos};
}

Wave friction_wave(const contact::CycleSegment& segment, const contact::PointParameters& point,
                   const contact::PointMotion& motion) {
  if (segment.state == ContactState::stick) {
    const double k = point.tangential_stiffness;
    return {segment.offset, k * motion.u_sin, k * motion.u_cos};
  }
  double limit = 0.0;  // separated, or slip without friction
  if (segment.state == ContactState::positive_slip) limit = point.friction_coefficient;
  if (segment.state == ContactState::negative_slip) limit = -point.friction_coefficient;
  const Wave n = normal_wave(point, motion);
  return {limit * n.A, limit * n.B, limit * n.C};
}

void add(HarmonicSeries& series, std::size_t i, const Integrals& part) {
  series.sin[i] += part.sin / std::numbers::pi;
  series.cos[i] += part.cos / std::numbers::pi;
}

}  // namespace

CycleHarmonics higher_harmonics(const contact::FrictionCycle& cycle,
                                const contact::PointParameters& point,
                                const contact::PointMotion& motion, int n_harmonics) {
  const auto n = static_cast<std::size_t>(n_harmonics - 1);
  CycleHarmonics result;
  for (HarmonicSeries* series : {&result.friction, &result.normal}) {
    series->sin.assign(n, 0.0);
    series->cos.assign(n, 0.0);
  }
  for (const contact::CycleSegment& segment : cycle.segments()) {
    if (segment.state == ContactState::separated) continue;
    const Wave friction = friction_wave(segment, point, motion);
    const Wave normal = normal_wave(point, motion);
    for (std::size_t i = 0; i < n; ++i) {
      const int h = static_cast<int>(i) + 2;
      add(result.friction, i, project(friction, h, segment));
      add(result.normal, i, project(normal, h, segment));
    }
  }
  return result;
}

}  // namespace microslip::pipelines
