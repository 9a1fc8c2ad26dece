#include "solver/continuation.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>

#include "solver/balance/first_harmonics.hpp"
#include "solver/balance/linear_force.hpp"
#include "solver/balance/linear_resonance.hpp"
#include "solver/branch/start_point.hpp"
#include "solver/curve/branch_search.hpp"
#include "solver/curve/chosen_curve.hpp"
#include "solver/curve/curve_tracer.hpp"
#include "solver/curve/linear_certificate.hpp"
#include "solver/curve/solved_point.hpp"
#include "solver/enrichment/curve_harmonics.hpp"

namespace microslip::solver {
namespace {

void check_range(const ContinuationOptions& options) {
  const auto bad = [](double frequency) { return !(frequency > 0.0) || !std::isfinite(frequency); };
  if (bad(options.frequency_begin) || bad(options.frequency_end)) {
    throw std::invalid_argument(
        "continuation: frequencies " + std::to_string(options.frequency_begin) + " and " +
        std::to_string(options.frequency_end) + " rad/s; both must be finite and above 0");
  }
  if (bad(options.residual_tolerance)) {
    throw std::invalid_argument("continuation: residual_tolerance " +
                                std::to_string(options.residual_tolerance) +
                                "; it must be finite and above 0");
  }
}

class Stopwatch {
 public:
  [[nodiscard]] double seconds() const {
    return std::chrono::duration<double>(Clock::now() - begin_).count();
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point begin_ = Clock::now();
};

void note_boundary_peak(ResponseCurve& curve) {
  if (!curve.complete || curve.points.size() < 2) return;
  const auto largest = std::max_element(
      curve.points.begin(), curve.points.end(),
      [](const ResponsePoint& a, const ResponsePoint& b) { return a.amplitude < b.amplitude; });
  const bool at_end = largest == curve.points.begin() || largest == std::prev(curve.points.end());
  if (!at_end || !(largest->amplitude > 0.0)) return;
  std::ostringstream text;
  text.precision(6);
  text << "peak at boundary: the largest amplitude lies at an end of the range, "
       << largest->amplitude << " m at " << 0.5 * largest->frequency / std::numbers::pi << " Hz";
  curve.message = text.str();
}

/// From the other end; the points are turned to the order asked for.
ResponseCurve trace_backwards(const Scene& scene, ContinuationOptions options,
                              const PointObserver& observe) {
  std::swap(options.frequency_begin, options.frequency_end);
  options.near_begin.reset();
  ResponseCurve curve = CurveTracer(scene, options, observe).run();
  std::reverse(curve.points.begin(), curve.points.end());
  return curve;
}

/// Two walks from the ends of the range that stop at the same place, or before they meet.
bool are_two_sides(const ContinuationOptions& options, const ResponseCurve& from_begin,
                   const ResponseCurve& from_end) {
  constexpr double overlap = 1e-3;  // of the range: a hairpin that neither gets out of
  const auto has_stopped = [](const ResponseCurve& curve) {
    return !curve.complete && curve.diagnosis != Diagnosis::budget && !curve.points.empty();
  };
  if (!has_stopped(from_begin) || !has_stopped(from_end)) return false;
  if (from_begin.points.front().q.n_harmonics() != from_end.points.front().q.n_harmonics()) {
    return false;
  }
  const auto progress = [&](const ResponsePoint& point) {
    return (point.frequency - options.frequency_begin) /
           (options.frequency_end - options.frequency_begin);
  };
  const double last = progress(*std::ranges::max_element(from_begin.points, {}, progress));
  const double first = progress(*std::ranges::min_element(from_end.points, {}, progress));
  return last <= first + overlap;
}

/// What another walk of the same curve has cost.
void add_work(ResponseCurve& curve, const ResponseCurve& other) {
  curve.iterations += other.iterations;
  curve.contact_evaluations += other.contact_evaluations;
  curve.state_readings += other.state_readings;
  curve.state_cuts += other.state_cuts;
}

/// A step that is refused as it swerves may lead into a tip, far smaller than itself, from which a
/// walk comes back: then such steps are taken. What leads back all the same is left.
ResponseCurve traced_past_loops(const Scene& scene, ContinuationOptions options,
                                const PointObserver& observe) {
  ResponseCurve curve = CurveTracer(scene, options, observe).run();
  if (curve.diagnosis != Diagnosis::loop) return curve;
  options.refuse_swerves = false;
  ResponseCurve past = CurveTracer(scene, options, observe).run();
  if (past.complete) {
    past.log.push_back({curve.points.back().frequency, Remedy::past_loop});
    add_work(past, curve);
    return past;
  }
  add_work(curve, past);
  options.refuse_swerves = true;
  options.leave_loops = true;
  ResponseCurve beyond = CurveTracer(scene, options, observe).run();
  add_work(beyond.complete ? beyond : curve, beyond.complete ? curve : beyond);
  return beyond.complete ? beyond : curve;
}

Eigen::MatrixXd limit_stiffness(const Scene& scene, LinearLimit limit) {
  const Eigen::Index n = scene.n_modes();
  if (limit == LinearLimit::free) return Eigen::MatrixXd::Zero(n, n);
  return scene.contact->stuck_stiffness();
}

/// The scene with another force in the place of its contact.
Scene with_force(const Scene& scene, std::unique_ptr<contact::ModalForce> force) {
  Scene other;
  other.natural_frequency = scene.natural_frequency;
  other.damping_ratio = scene.damping_ratio;
  other.excitation = scene.excitation;
  other.output = scene.output;
  other.contact = std::move(force);
  return other;
}

/// A linear response has the harmonics of its excitation alone.
ContinuationOptions with_excited_harmonics(const Scene& scene, const ContinuationOptions& options) {
  using enum HarmonicSet::Mean;
  const bool is_loaded = !scene.excitation.mean().isZero(0.0);
  return with_harmonics(
      options, HarmonicSet(least_harmonics(scene).orders(), is_loaded ? unknown : left_out));
}

std::string over_range(int n_intervals) {
  return " over the whole range (" + std::to_string(n_intervals) +
         (n_intervals == 1 ? " frequency interval" : " frequency intervals") + " looked at)";
}

/// The linear curve where it is proved to be one; nothing nonlinear is evaluated.
std::optional<ResponseCurve> trace_certified(const Scene& scene, const ContinuationOptions& options,
                                             const PointObserver& observe) {
  if (!options.linear_certificate || !scene.contact) return std::nullopt;
  const auto [low, high] = std::minmax(options.frequency_begin, options.frequency_end);
  const LinearCertificate proof =
      certify_linear(HarmonicBalance(scene, first_harmonics(scene, options)), low, high);
  if (proof.state == contact::LinearState::unknown) return std::nullopt;
  const bool stuck = proof.state == contact::LinearState::stuck;
  const LinearLimit limit = stuck ? LinearLimit::stuck : LinearLimit::free;
  const Scene linear = with_force(
      scene, std::make_unique<LinearForce>(limit_stiffness(scene, limit), *scene.contact));
  const ContinuationOptions excited = with_excited_harmonics(scene, options);
  ResponseCurve curve = CurveTracer(linear, excited, observe).run_linear();
  curve.certificate = std::string("proved ") + (stuck ? "fully stuck" : "free of contact") +
                      (low < high ? over_range(proof.n_intervals) : " at this frequency") +
                      ": the linear response is a solution; others may exist";
  return curve;
}

/// A linear curve as far as to an undamped resonance, where the response has no bound.
ResponseCurve trace_below(const Scene& linear, ContinuationOptions options, double resonance) {
  constexpr double nearest = 1e-3;  // of the frequency: some 500 times the static response
  const double way = resonance - options.frequency_begin;
  options.frequency_end = resonance - std::copysign(nearest * resonance, way);
  ResponseCurve curve;
  if (std::abs(way) > nearest * resonance) curve = CurveTracer(linear, options, {}).run_linear();
  if (curve.diagnosis != Diagnosis::none) return curve;
  curve.complete = false;
  curve.diagnosis = Diagnosis::unbounded;
  curve.message = "undamped resonance at " + std::to_string(resonance / (2.0 * std::numbers::pi)) +
                  " Hz: the linear response has no bound there";
  return curve;
}

/// The curve of a structure that no force moves, if the contact is in balance at rest: zero. A walk
/// would follow rounding errors of the preload.
std::optional<ResponseCurve> trace_at_rest(const Scene& scene, const ContinuationOptions& options,
                                           const PointObserver& observe) {
  if (!scene.contact || !scene.excitation.rows().isZero(0.0)) return std::nullopt;
  HarmonicBalance balance(scene, first_harmonics(scene, options));
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(balance.size());
  const BalanceEvaluation at = balance.evaluate(rest, options.frequency_begin);
  if (!(at.residual.norm() <= options.residual_tolerance)) return std::nullopt;
  const Eigen::Index n = scene.n_modes();
  const Eigen::Index sine = balance.orders_begin();
  Eigen::MatrixXd stiffness = at.jacobian.dense().block(sine, sine, n, n);
  stiffness.diagonal().array() -=
      scene.natural_frequency.array().square() - options.frequency_begin * options.frequency_begin;
  const Scene linear =
      with_force(scene, std::make_unique<LinearForce>(std::move(stiffness), *scene.contact));
  const ContinuationOptions excited = with_excited_harmonics(scene, options);
  ResponseCurve curve = CurveTracer(linear, excited, observe).run_linear();
  curve.contact_evaluations = 1;
  curve.certificate =
      "at rest: no force acts and the contact is in balance; other solutions may exist";
  return curve;
}

}  // namespace

ResponseCurve trace_response(const Scene& scene, const ContinuationOptions& options,
                             const PointObserver& observe) {
  check_range(options);
  const Stopwatch watch;
  std::optional<ResponseCurve> certified = trace_certified(scene, options, observe);
  if (!certified && options.frequency_begin == options.frequency_end) {
    return solve_at_frequency(scene, options.frequency_begin, options);
  }
  if (!certified) certified = trace_at_rest(scene, options, observe);
  if (!certified && options.harmonic_tolerance > 0.0)
    return trace_choosing(scene, options, observe);
  ResponseCurve curve =
      certified ? std::move(*certified) : traced_past_loops(scene, options, observe);
  if (!curve.complete && curve.certificate.empty() && curve.diagnosis != Diagnosis::interrupted) {
    ResponseCurve other = trace_backwards(scene, options, observe);
    const bool two_sides = are_two_sides(options, curve, other);
    const bool is_better =
        !two_sides && (other.complete || other.points.size() > curve.points.size());
    add_work(is_better ? other : curve, is_better ? curve : other);
    if (two_sides) {
      curve.points.insert(curve.points.end(), other.points.begin(), other.points.end());
      curve.log.insert(curve.log.end(), other.log.begin(), other.log.end());
      if (curve.diagnosis != Diagnosis::unbounded) {  // one resonance, met from both sides
        curve.message += "; from the end of the range: " + other.message;
      }
    } else if (is_better) {
      other.log.insert(other.log.begin(), curve.log.begin(), curve.log.end());
      other.log.push_back({options.frequency_end, Remedy::other_end});
      curve = std::move(other);
    }
  }
  note_boundary_peak(curve);
  if (options.search_starts > 0 && curve.diagnosis != Diagnosis::interrupted) {
    search_branches(scene, options, curve);
  }
  curve.seconds = watch.seconds();
  return curve;
}

ResponseCurve solve_at_frequency(const Scene& scene, double frequency,
                                 const ContinuationOptions& options) {
  ContinuationOptions here = options;
  here.frequency_begin = here.frequency_end = frequency;
  check_range(here);
  if (options.harmonic_tolerance > 0.0) return trace_choosing(scene, here, {});
  const Stopwatch watch;
  const HarmonicSet set = first_harmonics(scene, options);
  HarmonicBalance balance(scene, set);
  StartPoint start = find_start(balance, frequency, options.residual_tolerance,
                                options.near_begin ? &*options.near_begin : nullptr, options.stop);
  ResponseCurve curve;
  curve.iterations = start.iterations;
  curve.contact_evaluations = start.evaluations;
  std::optional<SolvedPoint> solved;
  if (start.solution) solved = solved_point(balance, *start.solution, options);
  if (solved) curve.contact_evaluations += solved->evaluations;
  if (solved && !solved->why.empty()) {
    curve.diagnosis = Diagnosis::uncertified;
    curve.message = std::move(solved->why);
    curve.log.push_back({frequency, Remedy::row_left_out});
  } else if (solved) {
    curve.points.push_back(std::move(solved->point));
    curve.points.back().contact_evaluations = curve.contact_evaluations;
    curve.points.back().seconds = watch.seconds();
    curve.complete = true;
    if (options.search_starts > 0) search_branches(scene, here, curve);
  } else {
    curve.diagnosis = start.is_stopped ? Diagnosis::interrupted : Diagnosis::no_start;
    curve.message = start.is_stopped ? "stopped" : "no solution found; tried " + start.way;
  }
  curve.seconds = watch.seconds();
  return curve;
}

std::vector<ResponsePoint> points_at_frequency(const Scene& scene, const ResponseCurve& curve,
                                               double frequency,
                                               const ContinuationOptions& options) {
  const HarmonicSet least = first_harmonics(scene, options);
  std::unique_ptr<HarmonicBalance> balance;
  std::vector<ResponsePoint> found;
  const auto solve_between = [&](const ResponsePoint& a, const ResponsePoint& b, double share) {
    const HarmonicSet set = least.united(a.orders).united(b.orders);
    if (!balance || balance->set() != set) balance = std::make_unique<HarmonicBalance>(scene, set);
    const Eigen::VectorXd guess =
        (1.0 - share) * balance->unknowns(a.q) + share * balance->unknowns(b.q);
    NewtonOptions newton;
    newton.tolerance = options.residual_tolerance;
    newton.max_iterations = 30;
    const NewtonResult solution = solve_at(*balance, guess, frequency, newton);
    if (!solution.converged) return;
    SolvedPoint solved = solved_point(*balance, solution, options);
    if (solved.why.empty()) found.push_back(std::move(solved.point));
  };
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    const ResponsePoint& b = curve.points[i];
    const ResponsePoint& a = curve.points[i > 0 ? i - 1 : 0];
    const bool repeated = i > 0 && a.frequency == b.frequency && a.q.vector() == b.q.vector();
    if (b.frequency == frequency && !repeated) solve_between(b, b, 1.0);
    const bool crosses = (a.frequency < frequency && b.frequency > frequency) ||
                         (a.frequency > frequency && b.frequency < frequency);
    if (crosses) solve_between(a, b, (frequency - a.frequency) / (b.frequency - a.frequency));
  }
  return found;
}

ResponseCurve trace_linear(const Scene& scene, LinearLimit limit,
                           const ContinuationOptions& options) {
  check_range(options);
  const Stopwatch watch;
  const Eigen::MatrixXd stiffness = scene.contact
                                        ? limit_stiffness(scene, limit)
                                        : Eigen::MatrixXd::Zero(scene.n_modes(), scene.n_modes());
  std::unique_ptr<contact::ModalForce> force;
  if (scene.contact) {
    const bool stuck = limit == LinearLimit::stuck;
    force = std::make_unique<LinearForce>(stiffness, stuck ? contact::CycleReport{1.0, 0.0, 0.0}
                                                           : contact::CycleReport{0.0, 0.0, 1.0});
  }
  const Scene linear = with_force(scene, std::move(force));
  ContinuationOptions alone = with_excited_harmonics(scene, options);
  alone.search_starts = 0;  // a linear response is the only one
  alone.linear_certificate = false;
  const std::optional<double> unbounded =
      unbounded_resonance(scene, stiffness, options.frequency_begin, options.frequency_end);
  ResponseCurve curve = unbounded ? trace_below(linear, alone, *unbounded)
                                  : CurveTracer(linear, alone, {}).run_linear();
  note_boundary_peak(curve);
  curve.seconds = watch.seconds();
  return curve;
}

}  // namespace microslip::solver
