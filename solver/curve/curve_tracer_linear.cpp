// The part of CurveTracer for scenes that are linear: no walk, no Newton's method.

#include <algorithm>
#include <cmath>
#include <utility>

#include "contact/bracketed_root.hpp"
#include "solver/balance/condensed.hpp"
#include "solver/balance/linear_resonance.hpp"
#include "solver/branch/start_point.hpp"
#include "solver/curve/curve_tracer.hpp"

namespace microslip::solver {
namespace {

// A step, of the distance to the nearest resonance: some ten points above 0.7 of a peak.
constexpr double density = 0.2;

// Of an amplitude that falls towards an antiresonance, a step changes so much; of the range, what a
// plot shows of such a notch.
constexpr double change = 0.3;
constexpr double shown = 1e-3;

double slope_of(const ResponsePoint& point) { return point.slope ? point.slope->amplitude : 0.0; }

/// [rad/s]; of an amplitude that hardly changes as long as may be.
double step_by_amplitude(const ResponsePoint& point, double range) {
  const double slope = std::abs(slope_of(point));
  const double step = slope > 0.0 ? change * point.amplitude / slope : range;
  return std::max(step, shown * range);
}

}  // namespace

NewtonResult CurveTracer::linear_response(double frequency) {
  NewtonResult at;
  at.point = {balance_->linear_response(frequency, balance_->stuck_stiffness()), frequency};
  const Scaling scaling = natural_scaling(*balance_, at.point.x, frequency);
  constexpr int most_refinements = 3;
  for (int i = 0;; ++i) {
    at.evaluation = balance_->evaluate(at.point.x, frequency);
    at.residual = at.evaluation.residual.norm() / scaling.residual;
    at.converged = at.residual <= std::max(options_.residual_tolerance, scaling.rounding);
    if (at.converged) return at;
    if (i == most_refinements) {
      at.converged = at.residual <= linear_rounding;
      return at;
    }
    at.point.x -= solved(at.evaluation.jacobian, at.evaluation.residual);
  }
}

/// Adds the peak between the last row and the next, or marks the one of them that it is; of light
/// damping the slope is a needle between them. @return false: the observer asked to stop.
bool CurveTracer::add_peak_before(ResponsePoint& now) {
  if (curve_.points.empty()) return true;
  const ResponsePoint& before = curve_.points.back();
  const double rise = slope_of(before), fall = slope_of(now);
  if (!(rise * forward() >= 0.0 && fall * forward() < 0.0)) return true;
  const double peak = contact::bracketed_root(
      [&](double there) { return slope_of(certified(linear_response(there), PointMark::peak)); },
      before.frequency, now.frequency, rise, fall);
  if (peak != before.frequency && peak != now.frequency) {
    return add(linear_response(peak), PointMark::peak);
  }
  (peak == now.frequency ? now : curve_.points.back()).mark = PointMark::peak;
  return true;
}

ResponseCurve CurveTracer::run_linear() {
  is_linear_ = true;
  const DrivenResonances resonances = driven_resonances(scene_, balance_->stuck_stiffness());
  const double end = options_.frequency_end;
  double frequency = options_.frequency_begin;
  for (bool goes_on = true;
       goes_on && static_cast<int>(curve_.points.size()) < options_.max_points;) {
    const NewtonResult at = linear_response(frequency);
    if (!at.converged) {
      stop(curve_.points.empty() ? Diagnosis::no_start : Diagnosis::newton_stall,
           at_hertz("rounding leaves more than 1e-6 of the linear equations (is the contact "
                    "stiffness right?)",
                    frequency));
      return finished();
    }
    ResponsePoint point = certified(at, PointMark::none);
    const double by_amplitude = step_by_amplitude(point, range_);
    goes_on = add_peak_before(point) && add(std::move(point));
    if (!goes_on) stop(Diagnosis::interrupted, at_hertz("stopped", frequency));
    if (frequency == end) {
      curve_.complete = goes_on;
      return finished();
    }
    if (options_.stop && options_.stop()) {
      stop(Diagnosis::interrupted, at_hertz("stopped", frequency));
      return finished();
    }
    const double near = density * resonances.distance(frequency);
    const double step = std::min(step_within_range(near, frequency), by_amplitude);
    const bool is_last = step >= std::abs(end - frequency);
    const double next = is_last ? end : frequency + forward() * step;
    frequency = resonances.first_within(frequency, next).value_or(next);
  }
  if (curve_.diagnosis == Diagnosis::none) stop(Diagnosis::budget, too_many_points());
  return finished();
}

}  // namespace microslip::solver
