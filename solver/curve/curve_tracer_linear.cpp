// The part of CurveTracer for scenes that are linear: no walk, no Newton's method.

#include <algorithm>
#include <cmath>
#include <utility>

#include "solver/balance/linear_resonance.hpp"
#include "solver/branch/start_point.hpp"
#include "solver/curve/curve_tracer.hpp"

namespace microslip::solver {
namespace {

// A step, of the distance to the nearest resonance: some ten points above 0.7 of a peak.
constexpr double density = 0.2;

double slope_of(const ResponsePoint& point) { return point.slope ? point.slope->amplitude : 0.0; }

}  // namespace

NewtonResult CurveTracer::linear_response(double frequency) {
  NewtonResult at;
  at.point = {balance_->linear_response(frequency, balance_->stuck_stiffness()), frequency};
  at.evaluation = balance_->evaluate(at.point.x, frequency);
  const Scaling scaling = natural_scaling(*balance_, at.point.x, frequency);
  at.residual = at.evaluation.residual.norm() / scaling.residual;
  at.converged = at.residual <= std::max(options_.residual_tolerance, scaling.rounding);
  return at;
}

/// Where the slope of the amplitude vanishes, to rounding: regula falsi, the weight of an end that
/// stays halved (Illinois).
double CurveTracer::linear_peak(const ResponsePoint& before, const ResponsePoint& now) {
  double low = before.frequency, high = now.frequency;
  double at_low = slope_of(before), at_high = slope_of(now);
  constexpr int most = 40;
  for (int i = 0; i < most && at_high != 0.0; ++i) {
    const double next = high - at_high * ((high - low) / (at_high - at_low));
    if (next == low || next == high) break;
    const double there = slope_of(certified(linear_response(next), PointMark::peak));
    if ((there > 0.0) == (at_high > 0.0)) {
      at_low *= 0.5;
    } else {
      low = high;
      at_low = at_high;
    }
    high = next;
    at_high = there;
  }
  return high;
}

ResponseCurve CurveTracer::run_linear() {
  const DrivenResonances resonances =
      driven_resonances(scene_, balance_->stuck_stiffness(), balance_->set().orders());
  const double end = options_.frequency_end;
  double frequency = options_.frequency_begin;
  for (bool goes_on = true;
       goes_on && static_cast<int>(curve_.points.size()) < options_.max_points;) {
    const NewtonResult at = linear_response(frequency);
    if (!at.converged) {
      stop(curve_.points.empty() ? Diagnosis::no_start : Diagnosis::newton_stall,
           at_hertz("the linear equations have no solution to the tolerance", frequency));
      return finished();
    }
    ResponsePoint point = certified(at, PointMark::none);
    if (!curve_.points.empty()) {
      const ResponsePoint& before = curve_.points.back();
      if (slope_of(before) * forward() > 0.0 && slope_of(point) * forward() < 0.0) {
        goes_on = add(linear_response(linear_peak(before, point)), PointMark::peak);
      }
    }
    goes_on = goes_on && add(std::move(point));
    if (!goes_on) stop(Diagnosis::interrupted, at_hertz("stopped", frequency));
    if (frequency == end) {
      curve_.complete = goes_on;
      return finished();
    }
    const double step = step_within_range(density * resonances.distance(frequency), frequency);
    const bool is_last = step >= std::abs(end - frequency);
    frequency = is_last ? end : frequency + forward() * step;
  }
  if (curve_.diagnosis == Diagnosis::none) stop(Diagnosis::budget, too_many_points());
  return finished();
}

}  // namespace microslip::solver
