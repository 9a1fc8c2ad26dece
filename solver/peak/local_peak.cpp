#include "solver/peak/local_peak.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "solver/balance/few_jacobians.hpp"
#include "solver/balance/output_amplitude.hpp"
#include "solver/branch/branch_geometry.hpp"
#include "solver/branch/branch_walker.hpp"
#include "solver/branch/special_points.hpp"
#include "solver/branch/start_point.hpp"
#include "solver/stability/stability.hpp"

namespace microslip::solver {
namespace {

// In scaled variables: a share of the amplitude or of the width of the resonance. Farther away lies
// another peak, or the step between the scenes is too long to tell.
constexpr double farthest = 0.5;
constexpr int max_steps = 25;  // uphill; the walker's step grows to 0.2 within four
// Of the amplitude per scaled length, where curvature is of order one: the peak is met already.
constexpr double level = 1e-13;
// Of the frequency: what a resonance is wide.
constexpr double narrowest = 1e-7;
constexpr double widest = 0.1;

struct Slope {
  double value = 0.0;  ///< da/ds [m] per scaled length
  double amplitude = 0.0;
};

Slope slope_along(const HarmonicBalance& balance, const Eigen::VectorXd& x,
                  const BranchVector& tangent, const Scaling& scaling) {
  const auto output = output_amplitude(balance.harmonics(x), balance.scene().output);
  return {balance.unknowns(output.gradient).dot(tangent.x) * scaling.x, output.half_peak_to_peak};
}

double distance(const BranchVector& a, const BranchVector& b, const Scaling& scaling) {
  return std::hypot((a.x - b.x).norm() / scaling.x,
                    (a.parameter - b.parameter) / scaling.parameter);
}

bool inside(double frequency, const ContinuationOptions& range) {
  return frequency >= std::min(range.frequency_begin, range.frequency_end) &&
         frequency <= std::max(range.frequency_begin, range.frequency_end);
}

/// @param direction  of the branch roughly, in variables of `scaling`.
LocalPeak made_peak(const HarmonicBalance& balance, const NewtonResult& at,
                    const BranchVector& direction, const Scaling& scaling) {
  LocalPeak peak;
  peak.point = at.point;
  peak.scaling = scaling;
  const double frequency = at.point.parameter;
  const double width = slow_flow_stability(balance, at.evaluation.jacobian, frequency).nearest;
  peak.scaling.parameter = std::clamp(width, narrowest * frequency, widest * frequency);
  const BranchVector along{direction.x,
                           direction.parameter * scaling.parameter / peak.scaling.parameter};
  peak.tangent = tangent_at(at, along, peak.scaling).direction;
  peak.amplitude = slope_along(balance, at.point.x, peak.tangent, scaling).amplitude;
  return peak;
}

/// Sign of the frequencies that lie in the range, seen from one of its ends; 0:
/// it is one frequency.
double inward(double frequency, const ContinuationOptions& range) {
  const double other = range.frequency_begin + range.frequency_end - frequency;
  return other > frequency ? 1.0 : other < frequency ? -1.0 : 0.0;
}

/// @param direction  as of made_peak().
LocalPeak made_end(const HarmonicBalance& balance, const NewtonResult& at, BranchVector direction,
                   const Scaling& scaling, const ContinuationOptions& range) {
  const double sign = inward(at.point.parameter, range);
  if (direction.parameter * sign < 0.0) {
    direction.x *= -1.0;
    direction.parameter *= -1.0;
  }
  LocalPeak end = made_peak(balance, at, direction, scaling);
  const Slope slope = slope_along(balance, at.point.x, end.tangent, end.scaling);
  end.place = PeakPlace::range_end;
  end.rises = sign != 0.0 && slope.value > level * slope.amplitude;
  return end;
}

/// A solution on the plane of the constraint.
NewtonResult solved(HarmonicBalance& balance, const BranchVector& guess,
                    const BranchVector& constraint, const Scaling& scaling,
                    const ContinuationOptions& range, PeakWork& work) {
  const NewtonOptions newton{.tolerance = range.residual_tolerance};
  NewtonResult result = solve_balance(balance, range.corrector, guess, constraint, scaling, newton);
  work.iterations += result.iterations;
  work.contact_evaluations += result.evaluations;
  return result;
}

std::optional<LocalPeak> follow_end(HarmonicBalance& balance, const LocalPeak& from,
                                    BranchVector guess, const ContinuationOptions& range,
                                    PeakWork& work) {
  guess.parameter = from.point.parameter;
  Scaling scaling = natural_scaling(balance, guess.x, guess.parameter);
  scaling.parameter = from.scaling.parameter;
  const BranchVector hold{Eigen::VectorXd::Zero(guess.x.size()), 1.0};
  const NewtonResult at = solved(balance, guess, hold, scaling, range, work);
  if (!at.converged || distance(at.point, guess, scaling) > farthest) return std::nullopt;
  const auto tangent = null_vector(at.evaluation, scaling, 1.0);
  if (!tangent) return std::nullopt;
  return made_end(balance, at, *tangent, scaling, range);
}

/// A solved point of a curve with the evaluation there.
NewtonResult evaluated(HarmonicBalance& balance, const ResponsePoint& point) {
  NewtonResult at;
  at.point = {balance.unknowns(point.q), point.frequency};
  at.evaluation = balance.evaluate(at.point.x, point.frequency);
  return at;
}

Scaling widest_scaling(const HarmonicBalance& balance, const BranchVector& at) {
  Scaling scaling = natural_scaling(balance, at.x, at.parameter);
  scaling.parameter = widest * at.parameter;
  return scaling;
}

/// The first peak of the last step.
std::optional<SpecialPoint> peak_of_step(HarmonicBalance& balance, BranchWalker& walker) {
  std::vector<SpecialPoint> found = peaks_between(walker, balance);
  if (found.empty()) return std::nullopt;
  return std::move(found.front());
}

/// Uphill from a point of the branch until a peak is passed.
std::optional<LocalPeak> climb(HarmonicBalance& balance, BranchWalker& walker,
                               const BranchVector& guess, const ContinuationOptions& range) {
  for (int i = 0; i < max_steps && walker.advance(); ++i) {
    if (const auto peak = peak_of_step(balance, walker)) {
      if (!peak->solved) return std::nullopt;
      const Scaling& scaling = walker.now().scaling;
      const bool near = distance(peak->solution.point, guess, scaling) < farthest;
      if (!near || !inside(peak->solution.point.parameter, range)) return std::nullopt;
      return made_peak(balance, peak->solution, walker.now().tangent, scaling);
    }
    const WalkerPoint& now = walker.now();
    if (distance(now.solution.point, guess, now.scaling) > farthest) return std::nullopt;
  }
  return std::nullopt;
}

}  // namespace

std::optional<LocalPeak> local_peak(HarmonicBalance& balance, const ResponsePoint& peak) {
  const NewtonResult at = evaluated(balance, peak);
  const Scaling scaling = widest_scaling(balance, at.point);
  const auto tangent = null_vector(at.evaluation, scaling, 1.0);
  if (!tangent) return std::nullopt;
  return made_peak(balance, at, *tangent, scaling);
}

std::optional<LocalPeak> local_end(HarmonicBalance& balance, const ResponsePoint& end,
                                   const ContinuationOptions& range) {
  const NewtonResult at = evaluated(balance, end);
  const Scaling scaling = widest_scaling(balance, at.point);
  const auto tangent = null_vector(at.evaluation, scaling, 1.0);
  if (!tangent) return std::nullopt;
  return made_end(balance, at, *tangent, scaling, range);
}

std::optional<LocalPeak> follow_peak(HarmonicBalance& balance, const LocalPeak& from,
                                     const BranchVector& guess, const ContinuationOptions& range,
                                     PeakWork& work) {
  if (from.place == PeakPlace::range_end) return follow_end(balance, from, guess, range, work);
  const ParametricSystem system = [&](const Eigen::VectorXd& x, double frequency) {
    return balance.evaluate(x, frequency);
  };
  const ScalingRule rule = [&](const NewtonResult& at) {
    Scaling scaling = natural_scaling(balance, at.point.x, at.point.parameter);
    scaling.parameter = from.scaling.parameter;
    return scaling;
  };
  NewtonResult guessed;
  guessed.point = guess;
  const Scaling scaling = rule(guessed);
  NewtonResult start = solved(balance, guess, from.tangent, scaling, range, work);
  if (!start.converged || distance(start.point, guess, scaling) > farthest) return std::nullopt;

  const BranchVector tangent = tangent_at(start, from.tangent, scaling).direction;
  const Slope slope = slope_along(balance, start.point.x, tangent, scaling);
  if (std::abs(slope.value) <= level * slope.amplitude && inside(start.point.parameter, range)) {
    return made_peak(balance, start, tangent, scaling);
  }
  const double forward = (slope.value > 0.0) == (tangent.parameter > 0.0) ? 1.0 : -1.0;
  BranchWalker walker(system, rule, std::move(start), forward, range.residual_tolerance);
  if (range.corrector == ContinuationOptions::Corrector::few_jacobians) {
    walker.economise(
        [&](const Eigen::VectorXd& x, double frequency) { return balance.residual(x, frequency); });
  }
  std::optional<LocalPeak> peak = climb(balance, walker, guess, range);
  work.iterations += walker.iterations();
  work.contact_evaluations += walker.evaluations();
  return peak;
}

}  // namespace microslip::solver
