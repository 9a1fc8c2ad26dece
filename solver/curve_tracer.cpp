#include "solver/curve_tracer.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <utility>

#include "solver/certificate.hpp"
#include "solver/special_points.hpp"
#include "solver/start_point.hpp"

namespace microslip::solver {
namespace {

// Bounds of a step in frequency, as shares of the range: ten points are the least a curve has, and
// a resonance narrower than the lower bound cannot be told from its neighbours in double precision.
constexpr double widest = 0.1;
constexpr double narrowest = 1e-7;

std::string at_hertz(const std::string& text, double frequency) {
  std::ostringstream stream;
  stream.precision(8);
  stream << text << " at " << frequency / (2.0 * std::numbers::pi) << " Hz";
  return stream.str();
}

}  // namespace

CurveTracer::CurveTracer(const Scene& scene, const ContinuationOptions& options,
                         const PointObserver& observe)
    : balance_(scene, options.n_harmonics),
      options_(options),
      observe_(observe),
      range_(std::abs(options.frequency_end - options.frequency_begin)) {}

double CurveTracer::progress(double frequency) const {
  return (frequency - options_.frequency_begin) /
         (options_.frequency_end - options_.frequency_begin);
}

StabilityReport CurveTracer::stability_at(const NewtonResult& at) {
  if (last_x_.size() != at.point.x.size() || last_x_ != at.point.x) {
    last_stability_ = assess_stability(balance_, at.evaluation.jacobian, at.point.parameter);
    last_x_ = at.point.x;
  }
  return last_stability_;
}

Scaling CurveTracer::scaling_at(const NewtonResult& at) {
  Scaling scaling = natural_scaling(balance_, at.point.x, at.point.parameter);
  scaling.parameter = std::clamp(stability_at(at).nearest, narrowest * range_, widest * range_);
  return scaling;
}

ResponsePoint CurveTracer::certified(const NewtonResult& at, PointMark mark) {
  ResponsePoint point = certified_point(balance_, at, at.point.parameter, stability_at(at));
  point.mark = mark;
  return point;
}

bool CurveTracer::add(const NewtonResult& at, PointMark mark) {
  curve_.points.push_back(certified(at, mark));
  return !observe_ || observe_(curve_.points.back());
}

void CurveTracer::stop(const std::string& diagnosis, const std::string& message) {
  curve_.diagnosis = diagnosis;
  curve_.message = message;
}

bool CurveTracer::add_specials(const BranchWalker& walker, double share_of_segment) {
  for (const SpecialPoint& special : special_points(walker, balance_)) {
    if (special.share < share_of_segment && !add(special.solution, special.mark)) return false;
  }
  return true;
}

bool CurveTracer::finish(const BranchWalker& walker) {
  const double before = walker.before().solution.point.parameter;
  const double now = walker.now().solution.point.parameter;
  const double share = (options_.frequency_end - before) / (now - before);
  const NewtonResult last = walker.at_parameter(options_.frequency_end, share);
  if (!last.converged) {
    stop("newton-stall", at_hertz("no solution found", options_.frequency_end));
    return false;
  }
  if (!add_specials(walker, share) || !add(last)) {
    stop("interrupted", at_hertz("stopped", options_.frequency_end));
    return false;
  }
  curve_.complete = true;
  return true;
}

void CurveTracer::walk(BranchWalker& walker) {
  while (static_cast<int>(curve_.points.size()) < options_.max_points) {
    if (!walker.advance()) {
      stop("newton-stall", at_hertz("Newton's method stalled and no remedy helped",
                                    walker.now().solution.point.parameter));
      return;
    }
    const double frequency = walker.now().solution.point.parameter;
    if (progress(frequency) >= 1.0) {
      static_cast<void>(finish(walker));
      return;
    }
    if (!add_specials(walker, 1.0) || !add(walker.now().solution)) {
      stop("interrupted", at_hertz("stopped", frequency));
      return;
    }
    if (progress(frequency) < -1e-9) {
      curve_.points.pop_back();
      stop("out-of-range",
           at_hertz("the branch turned back out of the range", options_.frequency_begin));
      return;
    }
  }
  stop("loop", "the branch did not reach the end within " + std::to_string(options_.max_points) +
                   " points");
}

ResponseCurve CurveTracer::run() {
  StartPoint start = find_start(balance_, options_.frequency_begin, options_.residual_tolerance);
  curve_.iterations = start.iterations;
  curve_.contact_evaluations = start.evaluations;
  if (!start.solution) {
    stop("no-start",
         at_hertz("no solution found", options_.frequency_begin) + "; tried " + start.way);
    return std::move(curve_);
  }
  const ParametricSystem system = [this](const Eigen::VectorXd& x, double frequency) {
    return balance_.evaluate(x, frequency);
  };
  const double forward = options_.frequency_end > options_.frequency_begin ? 1.0 : -1.0;
  BranchWalker walker(
      system, [this](const NewtonResult& at) { return scaling_at(at); }, *start.solution, forward);
  if (add(*start.solution)) {
    walk(walker);
  } else {
    stop("interrupted", "stopped at the first point");
  }
  curve_.iterations += walker.iterations();
  curve_.contact_evaluations += walker.evaluations();
  return std::move(curve_);
}

}  // namespace microslip::solver
