// The part of CurveTracer for scenes that are linear: no walk, no Newton's method.

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

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
  // Of a contact some 1e9 times stiffer than the modes rounding leaves more than elsewhere, as the
  // residual of every row tells.
  constexpr double of_rounding = 1e-6;
  constexpr int most_refinements = 3;
  for (int i = 0;; ++i) {
    at.evaluation = balance_->evaluate(at.point.x, frequency);
    at.residual = at.evaluation.residual.norm() / scaling.residual;
    at.converged = at.residual <= std::max(options_.residual_tolerance, scaling.rounding);
    if (at.converged) return at;
    if (i == most_refinements) {
      at.converged = at.residual <= of_rounding;
      return at;
    }
    at.point.x -= solved(at.evaluation.jacobian, at.evaluation.residual);
  }
}

/// Where the slope of the amplitude vanishes, to rounding: regula falsi, the weight of an end that
/// stays halved (Illinois), and the middle where that does not halve the bracket: of light damping
/// the slope is a needle in it.
double CurveTracer::linear_peak(const ResponsePoint& before, const ResponsePoint& now) {
  double low = before.frequency, high = now.frequency;
  double at_low = slope_of(before), at_high = slope_of(now);
  constexpr int most = 200;  // every second one halves the bracket
  bool is_slow = false;
  for (int i = 0; i < most && at_high != 0.0; ++i) {
    const double width = std::abs(high - low);
    const double next =
        is_slow ? std::midpoint(low, high) : high - at_high * ((high - low) / (at_high - at_low));
    if (next == low) return low;
    if (next == high) break;
    const double there = slope_of(certified(linear_response(next), PointMark::peak));
    if ((there > 0.0) == (at_high > 0.0)) {
      at_low *= 0.5;
    } else {
      low = high;
      at_low = at_high;
    }
    high = next;
    at_high = there;
    is_slow = !is_slow && std::abs(high - low) > 0.5 * width;
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
           at_hertz("rounding leaves more than 1e-6 of the linear equations (is the contact "
                    "stiffness right?)",
                    frequency));
      return finished();
    }
    ResponsePoint point = certified(at, PointMark::none);
    if (!curve_.points.empty()) {
      const ResponsePoint& before = curve_.points.back();
      if (slope_of(before) * forward() >= 0.0 && slope_of(point) * forward() < 0.0) {
        const double peak = slope_of(before) == 0.0 ? before.frequency : linear_peak(before, point);
        if (peak == before.frequency) {
          curve_.points.back().mark = PointMark::peak;
        } else if (peak == point.frequency) {
          point.mark = PointMark::peak;
        } else {
          goes_on = add(linear_response(peak), PointMark::peak);
        }
      }
    }
    const double by_amplitude = step_by_amplitude(point, range_);
    goes_on = goes_on && add(std::move(point));
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
