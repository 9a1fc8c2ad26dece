#include "solver/curve/curve_tracer.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "contact/phase.hpp"
#include "solver/balance/branch_factors.hpp"
#include "solver/balance/first_harmonics.hpp"
#include "solver/balance/linear_resonance.hpp"
#include "solver/branch/start_point.hpp"
#include "solver/curve/unmarked_points.hpp"

namespace microslip::solver {
namespace {

// Bounds of a step in frequency, as shares of the range: ten points are the least a curve has, and
// a resonance narrower than the lower bound cannot be told from its neighbours in double precision.
constexpr double widest = 0.1;
constexpr double narrowest = 1e-7;
// The same of the frequency: shorter steps, of a tiny range, would round to none.
constexpr double resolved = 1e-12;

// Share of the response by which it may change where the branch is interrupted, beyond what its
// tangent tells; more is another branch.
constexpr double same_branch = 0.05;
constexpr double longest_extrapolation = 0.3;  // of the response: a steep tangent tells no more
constexpr int most_restarts = 20;

bool on_the_branch(const WalkerPoint& last, const BranchVector& next) {
  const BranchVector& from = last.solution.point;
  const double ahead = (next.parameter - from.parameter) / last.scaling.parameter;
  const double along =
      std::abs(ahead / last.tangent.parameter) * last.tangent.x.norm() * last.scaling.x;
  const double size = from.x.norm();
  return (next.x - from.x).norm() <=
         same_branch * size + std::min(along, longest_extrapolation * size);
}

/// det ∂R/∂x = det [∂R/∂y; tᵀ] t_ω; empty: no factors came with the solution.
std::optional<double> sign_of_determinant(const NewtonResult& at) {
  if (!at.factors) return std::nullopt;
  const Tangent tangent = at.factors->tangent();
  if (tangent.orientation == 0.0) return std::nullopt;
  const double along = tangent.direction.parameter;
  return tangent.orientation * (along > 0.0 ? 1.0 : (along < 0.0 ? -1.0 : 0.0));
}

Diagnosis diagnosis_of(Stall stall) {
  if (stall == Stall::fold) return Diagnosis::fold_lost;
  return stall == Stall::chatter ? Diagnosis::event_chatter : Diagnosis::newton_stall;
}

}  // namespace

CurveTracer::CurveTracer(const Scene& scene, const ContinuationOptions& options,
                         const PointObserver& observe)
    : scene_(scene),
      options_(options),
      balance_(std::make_unique<HarmonicBalance>(scene, first_harmonics(scene, options))),
      observe_(observe),
      range_(std::abs(options.frequency_end - options.frequency_begin)) {
  const Eigen::MatrixXd free = Eigen::MatrixXd::Zero(scene.n_modes(), scene.n_modes());
  unbounded_ = unbounded_resonance(scene, free, options.frequency_begin, options.frequency_end);
}

double CurveTracer::progress(double frequency) const {
  return (frequency - options_.frequency_begin) /
         (options_.frequency_end - options_.frequency_begin);
}

StabilityReport CurveTracer::stability_at(const NewtonResult& at) {
  if (last_x_.size() != at.point.x.size() || last_x_ != at.point.x) {
    last_stability_ = slow_flow_stability(*balance_, at.evaluation.jacobian, at.point.parameter,
                                          sign_of_determinant(at));
    last_x_ = at.point.x;
  }
  return last_stability_;
}

Scaling CurveTracer::scaling_at(const NewtonResult& at) {
  Scaling scaling = natural_scaling(*balance_, at.point.x, at.point.parameter);
  scaling.parameter = step_within_range(stability_at(at).nearest, at.point.parameter);
  return scaling;
}

double CurveTracer::step_within_range(double width, double frequency) const {
  return std::max(std::clamp(width, narrowest * range_, widest * range_), resolved * frequency);
}

/// Counts what the walker has done since it was asked last.
void CurveTracer::take_stock(const BranchWalker& walker) {
  curve_.contact_evaluations += walker.evaluations() - walker_evaluations_;
  curve_.iterations += walker.iterations() - walker_iterations_;
  walker_evaluations_ = walker.evaluations();
  walker_iterations_ = walker.iterations();
  curve_.state_readings += walker.states().n_readings() - walker_readings_;
  curve_.state_cuts += walker.states().n_cuts() - walker_cuts_;
  walker_readings_ = walker.states().n_readings();
  walker_cuts_ = walker.states().n_cuts();
  for (; n_remedies_ < walker.remedies().size(); ++n_remedies_) {
    const StepRemedy& step = walker.remedies()[n_remedies_];
    curve_.log.push_back({step.parameter, step.remedy});
  }
}

void CurveTracer::stop(Diagnosis diagnosis, const std::string& message) {
  if (curve_.diagnosis == Diagnosis::uncertified) return;  // why the rest was not walked
  curve_.diagnosis = diagnosis;
  curve_.message = message;
}

/// A branch that was entered by a jump may be detached: then it comes back to where it was entered.
bool CurveTracer::closed(const BranchWalker& walker, int n_steps) const {
  constexpr int fewest = 10;  // steps away from the entry
  if (!entry_ || n_steps < fewest) return false;
  const Scaling& scaling = walker.now().scaling;
  const auto distance = [&](const BranchVector& a, const BranchVector& b) {
    return std::hypot((a.x - b.x).norm() / scaling.x,
                      (a.parameter - b.parameter) / scaling.parameter);
  };
  const BranchVector& now = walker.now().solution.point;
  const BranchVector entry{balance_->unknowns(entry_->q), entry_->frequency};
  return distance(now, entry) < distance(now, walker.before().solution.point);
}

/// A branch passes each of its folds once. Who meets one again goes back along the branch, or round
/// in circles: a step has led to another part of it, or to a branch that is detached.
std::optional<std::size_t> CurveTracer::came_back(std::size_t n_before) const {
  constexpr double same_frequency = 1e-11;  // folds as near to each other as 1e-8 were seen
  constexpr double same_motion = 1e-6;      // the square root is what a fold leaves open
  const auto same = [&](const ResponsePoint& a, const ResponsePoint& b) {
    return std::abs(a.frequency - b.frequency) <= same_frequency * a.frequency &&
           (a.q.vector() - b.q.vector()).norm() <= same_motion * a.q.vector().norm();
  };
  const auto& points = curve_.points;
  for (std::size_t i = n_before; i < points.size(); ++i) {
    if (points[i].mark != PointMark::fold) continue;
    for (std::size_t j = 0; j < n_before; ++j) {
      if (points[j].mark == PointMark::fold && same(points[i], points[j])) return j;
    }
  }
  return std::nullopt;
}

/// Friction takes a work that grows with the amplitude, as that of the excitation does: where it is
/// the smaller one, nothing bounds an undamped resonance of the free structure,
/// and the branch climbs for ever.
bool CurveTracer::endless() const {
  constexpr double near = 1e-6;  // of the frequency: 5e5 times the static response
  constexpr double high = 1e4;   // times the first point
  if (curve_.points.empty()) return false;
  const ResponsePoint& now = curve_.points.back();
  return unbounded_ && std::abs(now.frequency - *unbounded_) <= near * *unbounded_ &&
         now.amplitude > high * curve_.points.front().amplitude;
}

bool CurveTracer::walk(BranchWalker& walker) {
  for (int n_steps = 0; static_cast<int>(curve_.points.size()) < options_.max_points; ++n_steps) {
    const bool stepped = walker.advance();
    take_stock(walker);
    if (!stepped) return true;
    const double frequency = walker.now().solution.point.parameter;
    if (progress(frequency) >= 1.0) {
      if (reach(walker, options_.frequency_end))
        curve_.complete = curve_.diagnosis == Diagnosis::none;
      return false;
    }
    if (progress(frequency) < -1e-9) {
      if (reach(walker, options_.frequency_begin)) {
        stop(Diagnosis::out_of_range,
             at_hertz("the branch turned back out of the range", options_.frequency_begin));
      }
      return false;
    }
    const std::size_t n_before = curve_.points.size();
    if (!add_specials(walker, 1.0) ||
        !add(walker.now().solution, PointMark::none, Held::place_on_the_branch)) {
      stop(Diagnosis::interrupted, at_hertz("stopped", frequency));
      return false;
    }
    loop_ = came_back(n_before);
    if (loop_) {
      stop(Diagnosis::loop, at_hertz("the branch comes back to where it was", frequency));
      return false;
    }
    if (endless()) {
      stop(Diagnosis::unbounded,
           at_hertz("an undamped resonance that friction does not hold", frequency));
      return false;
    }
    if (closed(walker, n_steps)) {
      stop(Diagnosis::loop,
           at_hertz("the branch is closed and was entered by a jump", entry_->frequency));
      return false;
    }
  }
  stop(Diagnosis::budget, too_many_points());
  return false;
}

/// With the place where the walk is slow.
std::string CurveTracer::too_many_points() const {
  const auto& points = curve_.points;
  const auto half = points.begin() + std::ssize(points) / 2;
  const auto [low, high] = std::minmax_element(
      half, points.end(),
      [](const ResponsePoint& a, const ResponsePoint& b) { return a.frequency < b.frequency; });
  std::ostringstream stream;
  stream.precision(8);
  stream << "the branch did not reach the end within " << options_.max_points
         << " points, half of which lie from " << low->frequency / contact::two_pi << " to "
         << high->frequency / contact::two_pi << " Hz";
  return stream.str();
}

double CurveTracer::forward() const {
  return options_.frequency_end > options_.frequency_begin ? 1.0 : -1.0;
}

BranchWalker CurveTracer::walker_from(NewtonResult start, double way) {
  const ParametricSystem system = [this](const Eigen::VectorXd& x, double frequency) {
    return balance_->evaluate(x, frequency);
  };
  walker_evaluations_ = walker_iterations_ = 0;
  walker_readings_ = walker_cuts_ = 0;
  n_remedies_ = 0;
  BranchWalker walker(
      system, [this](const NewtonResult& at) { return scaling_at(at); }, std::move(start), way,
      options_.residual_tolerance);
  if (options_.corrector == ContinuationOptions::Corrector::few_jacobians) {
    walker.economise([this](const Eigen::VectorXd& x, double frequency) {
      return balance_->residual(x, frequency);
    });
  }
  if (!options_.refuse_swerves) walker.take_swerves();
  if (scene_.contact) {
    walker.watch([this](const BranchVector& at, contact::ContactStates& states) {
      balance_->states(at.x, at.parameter, states);
    });
  }
  return walker;
}

/// The plain corrector on the branch as it was walked, beyond the place of the stall.
/// @return empty: it was walked towards the end of the range, or nothing is found.
std::optional<CurveTracer::Restart> CurveTracer::restart_against_the_range(
    const BranchWalker& stalled) {
  const WalkerPoint& from = stalled.now();
  if (from.tangent.parameter * forward() >= 0.0) return std::nullopt;
  for (const double beyond : {1e-6, 1e-5, 1e-4, 1e-3}) {
    const double frequency = from.solution.point.parameter - beyond * forward() * range_;
    if (progress(frequency) <= 0.0) break;
    NewtonResult corrected = corrected_at(from.solution.point.x, frequency);
    if (!corrected.converged || !on_the_branch(from, corrected.point)) continue;
    curve_.log.push_back({from.solution.point.parameter, Remedy::fixed_frequency});
    return Restart{std::move(corrected), -forward()};
  }
  return std::nullopt;
}

/// Along the chord between the points before one of the curve that are at least as far from
/// `frequency` as what lies `way` beyond it, and twice as far.
Eigen::VectorXd CurveTracer::extrapolated(std::ptrdiff_t before, double frequency,
                                          double way) const {
  const auto last_at = [&](double distance) {
    auto i = static_cast<std::size_t>(before);
    while (i > 0 && std::abs(curve_.points[i].frequency - frequency) < distance) --i;
    return i;
  };
  const ResponsePoint& near = curve_.points[last_at(std::abs(way))];
  const ResponsePoint& far = curve_.points[last_at(2.0 * std::abs(way))];
  const Eigen::VectorXd x = balance_->unknowns(near.q);
  const double step = near.frequency - far.frequency;
  if (step == 0.0) return x;
  return x + (frequency + way - near.frequency) / step * (x - balance_->unknowns(far.q));
}

/// Hairpins as small as the errors of forces lead a walk back the way it has come. What was walked
/// twice is no part of the curve; farther on than it has led, the branch that it belongs to goes on
/// with all but the same motion.
std::optional<CurveTracer::Restart> CurveTracer::restart_beyond_loop() {
  if (!loop_) return std::nullopt;
  auto& points = curve_.points;
  const auto fold = points.begin() + static_cast<std::ptrdiff_t>(*loop_);
  const double frequency =
      std::max_element(fold, points.end(), [this](const auto& a, const auto& b) {
        return progress(a.frequency) < progress(b.frequency);
      })->frequency;
  const Eigen::VectorXd x = balance_->unknowns(fold->q);
  for (const double ahead : {1e-6, 1e-5, 1e-4, 1e-3, 1e-2}) {
    const double way = ahead * forward() * range_;
    const double there = frequency + way;
    if (progress(there) >= 1.0) break;
    // At the fold itself the Jacobian is singular.
    NewtonResult corrected =
        corrected_at(extrapolated(fold - points.begin(), frequency, way), there);
    const bool is_near = (corrected.point.x - x).norm() <= same_branch * x.norm();
    if (!corrected.converged || !is_near) continue;
    curve_.log.push_back({fold->frequency, Remedy::fixed_frequency});
    points.erase(fold + 1, points.end());
    curve_.diagnosis = Diagnosis::none;
    curve_.message.clear();
    return Restart{std::move(corrected), forward()};
  }
  return std::nullopt;
}

NewtonResult CurveTracer::corrected_at(const Eigen::VectorXd& guess, double frequency) {
  NewtonOptions newton;
  newton.tolerance = options_.residual_tolerance;
  newton.max_iterations = 40;
  NewtonResult corrected = solve_at(*balance_, guess, frequency, newton);
  curve_.contact_evaluations += corrected.evaluations;
  curve_.iterations += corrected.iterations;
  return corrected;
}

/// The ladder above the walker's own remedies: the plain corrector at a fixed frequency, then
/// homotopies from the linear limits, at growing distances.
std::optional<CurveTracer::Restart> CurveTracer::restart(const BranchWalker& stalled) {
  if (auto beyond = restart_against_the_range(stalled)) return beyond;
  const BranchVector& from = stalled.now().solution.point;
  const bool came_from_there = stalled.now().tangent.parameter * forward() < 0.0;
  for (const double ahead : {1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 3e-2}) {
    const double frequency = from.parameter + ahead * forward() * range_;
    if (progress(frequency) >= 1.0) break;
    NewtonResult corrected = corrected_at(from.x, frequency);
    const bool plain =
        corrected.converged && !(came_from_there && on_the_branch(stalled.now(), corrected.point));
    if (!plain) {
      StartPoint start =
          find_start(*balance_, frequency, options_.residual_tolerance, nullptr, options_.stop);
      curve_.contact_evaluations += start.evaluations;
      curve_.iterations += start.iterations;
      if (start.is_stopped) break;
      if (!start.solution) continue;
      if (came_from_there && on_the_branch(stalled.now(), start.solution->point)) continue;
      corrected = std::move(*start.solution);
    }
    curve_.log.push_back({from.parameter, plain ? Remedy::fixed_frequency : Remedy::homotopy});
    return Restart{std::move(corrected), forward()};
  }
  return std::nullopt;
}

void CurveTracer::use(const HarmonicSet& set) {
  balance_ = std::make_unique<HarmonicBalance>(scene_, set);
  last_x_.resize(0);
}

ResponseCurve CurveTracer::finished() {
  mark_unsolved(curve_);
  tell_left_out();
  return std::move(curve_);
}

ResponseCurve CurveTracer::follow(NewtonResult start, const HarmonicSet& set) {
  use(set);
  entry_ = {balance_->harmonics(start.point.x), start.point.parameter};
  if (!add(start)) return finished();
  BranchWalker walker = walker_from(std::move(start), forward());
  if (walk(walker)) {
    stop(diagnosis_of(walker.stall()),
         at_hertz("Newton's method stalled", walker.now().solution.point.parameter));
  }
  return finished();
}

ResponseCurve CurveTracer::run() {
  StartPoint start =
      find_start(*balance_, options_.frequency_begin, options_.residual_tolerance,
                 options_.near_begin ? &*options_.near_begin : nullptr, options_.stop);
  curve_.iterations = start.iterations;
  curve_.contact_evaluations = start.evaluations;
  if (start.is_stopped) {
    stop(Diagnosis::interrupted,
         at_hertz("stopped before its first point", options_.frequency_begin));
    return finished();
  }
  if (!start.solution) {
    stop(Diagnosis::no_start,
         at_hertz("no solution found", options_.frequency_begin) + "; tried " + start.way);
    return finished();
  }
  std::optional<Restart> next = Restart{std::move(*start.solution), forward()};
  for (int restarts = 0; next && restarts <= most_restarts; ++restarts) {
    if (!add(next->at)) {
      stop(Diagnosis::interrupted, at_hertz("stopped", next->at.point.parameter));
      return finished();
    }
    BranchWalker walker = walker_from(std::move(next->at), next->way);
    if (!walk(walker)) {
      next = options_.leave_loops ? restart_beyond_loop() : std::nullopt;
      if (!next) return finished();
      continue;
    }
    const double last = walker.now().solution.point.parameter;
    const Diagnosis stall = diagnosis_of(walker.stall());
    next = restart(walker);
    if (!next) {
      stop(stall, at_hertz("Newton's method stalled and no remedy helped", last));
    } else if (!on_the_branch(walker.now(), next->at.point)) {
      stop(Diagnosis::branch_jump,
           at_hertz(std::string(to_string(stall)) + ", and another branch beyond it", last));
      curve_.log.push_back({last, Remedy::other_branch});
      entry_ = {balance_->harmonics(next->at.point.x), next->at.point.parameter};
    }
  }
  if (next)
    stop(Diagnosis::event_chatter, at_hertz("stalled again and again", next->at.point.parameter));
  return finished();
}

}  // namespace microslip::solver
