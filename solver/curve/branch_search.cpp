#include "solver/curve/branch_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <sstream>
#include <utility>

#include "contact/dense.hpp"
#include "solver/balance/condensed.hpp"
#include "solver/balance/first_harmonics.hpp"
#include "solver/branch/start_point.hpp"
#include "solver/curve/curve_tracer.hpp"
#include "solver/curve/solved_point.hpp"
#include "solver/enrichment/curve_harmonics.hpp"
#include "solver/sampled_walk.hpp"

namespace microslip::solver {
namespace {

constexpr int n_inside = 7;  // frequencies, evenly
// Of the range. At a fold two known solutions meet and the equations are singular; this far beside
// it they are apart, or not there.
constexpr double beside_fold = 1e-3;
constexpr double same_frequency = 1e-4;  // closer to another by this share of it, and of the range:
                                         // what there is beside it shows from there
constexpr int most_iterations = 60;
constexpr double cheap_tolerance = 1e-8;  // of what is solved closer, or with closer forces
constexpr int most_halvings = 6;
constexpr double longest_step = 3.0;  // of the amplitude: deflation scales steps without bound
constexpr double unbounded = 1e6;     // of a linear response, over the amplitude
// Closer to a known solution, over the amplitude, it is that solution.
constexpr double distinct = 1e-5;
constexpr std::size_t most_branches = 10;
constexpr int most_points_beside = 2000;  // of what is no row; a curve takes some hundred

/// Resonances with a stiffness added [rad/s].
Eigen::VectorXd resonances(const Scene& scene, const Eigen::MatrixXd& stiffness) {
  Eigen::MatrixXd all = stiffness;
  all.diagonal() += scene.natural_frequency.cwiseAbs2();
  return contact::symmetric_eigenvalues(all).value_or(Eigen::VectorXd()).cwiseMax(0.0).cwiseSqrt();
}

/// Where other solutions are looked for [rad/s], ascending, each once.
std::vector<double> search_frequencies(const Scene& scene, const ContinuationOptions& options,
                                       const ResponseCurve& curve) {
  const auto [low, high] = std::minmax(options.frequency_begin, options.frequency_end);
  const double range = high - low;
  if (range == 0.0) return {low};
  std::vector<double> all{low, high};
  for (int i = 0; i < n_inside; ++i) all.push_back(low + (i + 0.5) / n_inside * range);
  const auto add = [&, least = low, most = high](double frequency) {
    if (frequency > least && frequency < most) all.push_back(frequency);
  };
  for (const ResponsePoint& point : curve.points) {
    if (point.mark == PointMark::peak) add(point.frequency);
    if (point.mark != PointMark::fold) continue;
    add(point.frequency - beside_fold * range);
    add(point.frequency + beside_fold * range);
  }
  for (const double frequency : scene.natural_frequency) add(frequency);
  for (const double frequency : resonances(scene, scene.contact->stuck_stiffness())) add(frequency);
  std::sort(all.begin(), all.end());
  const auto same = [&](double a, double b) {
    return b - a < std::min(same_frequency * b, beside_fold * range);
  };
  all.erase(std::unique(all.begin(), all.end(), same), all.end());
  return all;
}

/// The range in which the branch of a solution at one frequency may fold and come back: from the
/// free to the stuck resonance of the modes between which it lies, and a little beside.
ContinuationOptions range_about(const Scene& scene, ContinuationOptions options) {
  constexpr double beside = 0.05;
  constexpr double farthest = 0.25;  // of the frequency
  const Eigen::Index n = scene.n_modes();
  const Eigen::VectorXd free = resonances(scene, Eigen::MatrixXd::Zero(n, n));
  const Eigen::VectorXd stuck = resonances(scene, scene.contact->stuck_stiffness());
  const double frequency = options.frequency_begin;
  double low = (1.0 - beside) * frequency;
  double high = (1.0 + beside) * frequency;
  for (Eigen::Index i = 0; i < std::min(free.size(), stuck.size()); ++i) {
    const double from = (1.0 - beside) * free[i];
    const double to = (1.0 + beside) * stuck[i];
    if (from > frequency || to < frequency) continue;
    low = std::min(low, from);
    high = std::max(high, to);
  }
  options.frequency_begin = std::max(low, (1.0 - farthest) * frequency);
  options.frequency_end = std::min(high, (1.0 + farthest) * frequency);
  options.judge_stability = options.require_proof = false;
  options.max_points = std::min(options.max_points, most_points_beside);
  return options;
}

/// From a resonance beside the range, free or stuck, through the end next to it: a branch that
/// leans into the range rises there. Begins where motions are small.
std::vector<ContinuationOptions> ranges_from_beside(const Scene& scene,
                                                    const ContinuationOptions& options,
                                                    const HarmonicSet& set) {
  constexpr double beside = 0.05;
  constexpr double farthest = 0.25;  // of the frequency
  const auto [low, high] = std::minmax(options.frequency_begin, options.frequency_end);
  double below = low;
  double above = high;
  const Eigen::Index n = scene.n_modes();
  for (const Eigen::MatrixXd& stiffness :
       {Eigen::MatrixXd(Eigen::MatrixXd::Zero(n, n)), scene.contact->stuck_stiffness()}) {
    for (const double one : resonances(scene, stiffness)) {
      if (one > (1.0 - farthest) * low) below = std::min(below, one);
      if (one < (1.0 + farthest) * high) above = std::max(above, one);
    }
  }
  ContinuationOptions range = with_harmonics(options, set);
  range.search_starts = 0;
  range.near_begin.reset();
  range.judge_stability = range.require_proof = false;
  range.max_points = std::min(range.max_points, most_points_beside);
  std::vector<ContinuationOptions> ranges;
  const auto add = [&](double begin, double end) {
    range.frequency_begin = begin;
    range.frequency_end = end;
    ranges.push_back(range);
  };
  if (below < low) add((1.0 - beside) * below, high);
  if (above > high) add((1.0 + beside) * above, low);
  return ranges;
}

class Search {
 public:
  Search(const Scene& scene, const ContinuationOptions& options, ResponseCurve& curve)
      : scene_(scene), options_(options), curve_(curve) {}

  void run() {
    trace_beside();
    for (const double frequency : search_frequencies(scene_, options_, curve_)) {
      if (is_stopped()) return;
      search_at(frequency);
    }
    tell_cut();
  }

 private:
  void search_at(double frequency) {
    balance_ = std::make_unique<HarmonicBalance>(scene_, known_harmonics());
    std::vector<Eigen::VectorXd> known = known_at(frequency);
    if (frequency == options_.frequency_begin || frequency == options_.frequency_end) {
      keep_entries(frequency, known);
    }
    if (is_point()) {
      for (const Eigen::VectorXd& own : std::vector(known)) keep_crossings(own, frequency, known);
    }
    if (options_.search_scene) {
      cheap_ = std::make_unique<HarmonicBalance>(*options_.search_scene, balance_->set());
    }
    std::vector<Eigen::VectorXd> divided = cheaply(known, frequency);
    for (int i = 0; i < options_.search_starts; ++i) {
      if (curve_.detached.size() >= most_branches || is_stopped()) return;
      ++curve_.n_starts;
      const std::optional<Eigen::VectorXd> found =
          deflated(start(i, frequency, known), frequency, divided);
      if (!found) continue;
      const auto x = keep_new(*found, frequency, known);
      if (x && is_point()) keep_crossings(*x, frequency, known);
      if (x) divided = cheaply(known, frequency);
      if (cheap_ && !near(*found, divided)) divided.push_back(*found);  // once is enough
    }
  }

  /// In which starts are tried.
  [[nodiscard]] HarmonicBalance& tried() { return cheap_ ? *cheap_ : *balance_; }

  /// The known solutions as cheaper forces have them.
  [[nodiscard]] std::vector<Eigen::VectorXd> cheaply(std::vector<Eigen::VectorXd> known,
                                                     double frequency) {
    if (!cheap_) return known;
    for (Eigen::VectorXd& x : known) {
      NewtonResult solution = solve_at(*cheap_, x, frequency, {.tolerance = cheap_tolerance});
      count(solution.iterations, solution.evaluations);
      if (solution.converged) x = std::move(solution.point.x);
    }
    return known;
  }

  /// All that the branches known have: solutions are compared in the same unknowns.
  [[nodiscard]] HarmonicSet known_harmonics() const {
    HarmonicSet set = first_harmonics(scene_, options_);
    for (const ResponsePoint& point : curve_.points) set = set.united(point.orders);
    for (const DetachedBranch& branch : curve_.detached) {
      for (const ResponsePoint& point : branch.points) set = set.united(point.orders);
    }
    return set;
  }

  /// The branch of a solution near a guess. @return  the solution; empty: none, or one known.
  std::optional<Eigen::VectorXd> keep_new(const Eigen::VectorXd& guess, double frequency,
                                          std::vector<Eigen::VectorXd>& known) {
    NewtonResult solution = solved_near(guess, frequency);
    if (!solution.converged || near(solution.point.x, known)) return std::nullopt;
    Eigen::VectorXd x = solution.point.x;
    keep_branch(std::move(solution));
    known = known_at(frequency);  // the branch may come back to this frequency
    if (!near(x, known)) known.push_back(x);
    return x;
  }

  void trace_beside() {
    for (const ContinuationOptions& range :
         ranges_from_beside(scene_, options_, known_harmonics())) {
      if (is_stopped()) return;
      beside_.push_back({range, CurveTracer(scene_, range, observer()).run()});
      curve_.iterations += beside_.back().curve.iterations;
      curve_.contact_evaluations += beside_.back().curve.contact_evaluations;
    }
  }

  /// Branches that come in at an end of the range from resonances beside it.
  void keep_entries(double frequency, std::vector<Eigen::VectorXd>& known) {
    for (const auto& [range, beside] : beside_) {
      for (const ResponsePoint& point : points_at_frequency(scene_, beside, frequency, range)) {
        if (curve_.detached.size() >= most_branches || is_stopped()) return;
        static_cast<void>(keep_new(balance_->unknowns(point.q), frequency, known));
      }
    }
  }

  /// Of one walk.
  [[nodiscard]] PointObserver observer() const {
    return [this, walk = SampledWalk()](const ResponsePoint& point) mutable {
      walk.add(point);
      const bool leaves = options_.leave_sampled_walks && walk.is_led_by_errors();
      return !leaves && !is_stopped();
    };
  }

  [[nodiscard]] bool is_stopped() const { return left_ || (options_.stop && options_.stop()); }

  [[nodiscard]] bool is_point() const { return options_.frequency_begin == options_.frequency_end; }

  [[nodiscard]] NewtonResult solved_near(const Eigen::VectorXd& x, double frequency) {
    NewtonOptions newton;
    newton.tolerance = options_.residual_tolerance;
    NewtonResult solution = solve_at(*balance_, x, frequency, newton);
    count(solution.iterations, solution.evaluations);
    return solution;
  }

  /// Of one frequency: where the branch of a solution comes back to it.
  void keep_crossings(const Eigen::VectorXd& x, double frequency,
                      std::vector<Eigen::VectorXd>& known) {
    if (is_stopped()) return;
    NewtonResult start = solved_near(x, frequency);
    if (!start.converged) return;
    const ContinuationOptions range = range_about(scene_, options_);
    const DetachedBranch branch = followed(std::move(start), range);
    ResponseCurve about;
    about.points = branch.points;
    if (branch.closed) about.points.push_back(branch.points.front());
    for (const ResponsePoint& point : points_at_frequency(scene_, about, frequency, range)) {
      if (curve_.detached.size() >= most_branches) return;
      NewtonResult solution = solved_near(balance_->unknowns(point.q), frequency);
      if (!solution.converged || near(solution.point.x, known)) continue;
      known.push_back(solution.point.x);
      keep_branch(std::move(solution));
    }
  }

  void count(int iterations, int evaluations) {
    curve_.iterations += iterations;
    curve_.contact_evaluations += evaluations;
  }

  [[nodiscard]] std::vector<Eigen::VectorXd> known_at(double frequency) const {
    std::vector<Eigen::VectorXd> known;
    ContinuationOptions all = options_;  // what is no row would be found again
    all.require_proof = false;
    all.judge_stability = false;
    const auto add = [&](const ResponseCurve& curve) {
      for (const auto& point : points_at_frequency(scene_, curve, frequency, all)) {
        Eigen::VectorXd x = balance_->unknowns(point.q);
        if (point.orders != balance_->set().orders()) {
          NewtonResult solution = solve_at(*balance_, x, frequency, {});
          if (solution.converged) x = std::move(solution.point.x);
        }
        known.push_back(std::move(x));
      }
    };
    add(curve_);
    for (const DetachedBranch& branch : curve_.detached) {
      ResponseCurve other;
      other.points = branch.points;
      // A closed branch has a piece between its last point and its first.
      if (branch.closed) other.points.push_back(branch.points.front());
      add(other);
    }
    return known;
  }

  [[nodiscard]] static bool near(const Eigen::VectorXd& x,
                                 const std::vector<Eigen::VectorXd>& known) {
    return std::any_of(known.begin(), known.end(), [&](const Eigen::VectorXd& other) {
      return (x - other).norm() <= distinct * std::max(x.norm(), other.norm());
    });
  }

  /// Places far apart: known and linear solutions, shrunk, grown and turned in phase.
  [[nodiscard]] Eigen::VectorXd start(int index, double frequency,
                                      const std::vector<Eigen::VectorXd>& known) const {
    constexpr std::array<double, 8> factors{1.0, 3.0, 10.0, 0.3, 30.0, 0.1, 100.0, 2.0};
    const Eigen::Index n = scene_.n_modes();
    const int n_bases = 2 + static_cast<int>(known.size());
    const int base = index % n_bases;
    const int round = index / n_bases;
    Eigen::VectorXd x =
        base == 0   ? balance_->linear_response(frequency, balance_->stuck_stiffness())
        : base == 1 ? balance_->linear_response(frequency, Eigen::MatrixXd::Zero(n, n))
                    : known[static_cast<std::size_t>(base - 2)];
    double size = 0.0;
    for (const Eigen::VectorXd& other : known) size = std::max(size, other.norm());
    // At a resonance without damping a linear response has no size that tells anything.
    const bool is_bounded = x.allFinite() && (size == 0.0 || x.norm() < unbounded * size);
    if (!is_bounded)
      x.setConstant(size > 0.0 ? size / std::sqrt(static_cast<double>(x.size())) : 1.0);
    Harmonics q =
        balance_->harmonics(factors[static_cast<std::size_t>(round) % factors.size()] * x);
    const double turn = 1.0 * round;  // rad: never the same twice
    for (int k = 1; k <= q.n_harmonics(); ++k) {
      const Eigen::RowVectorXd sine = q.sine(k);
      const Eigen::RowVectorXd cosine = q.cosine(k);
      q.rows().row(2 * k - 1) = std::cos(k * turn) * sine - std::sin(k * turn) * cosine;
      q.rows().row(2 * k) = std::sin(k * turn) * sine + std::cos(k * turn) * cosine;
    }
    return balance_->unknowns(q);
  }

  /// m ‖R‖; infinite where a step has ended in a known solution to the last bit, whose m has no
  /// value.
  [[nodiscard]] static double merit(const Eigen::VectorXd& x, double size,
                                    const std::vector<Eigen::VectorXd>& known,
                                    const Eigen::VectorXd& residual) {
    double product = residual.norm();
    for (const Eigen::VectorXd& other : known) {
      const double square = (x - other).squaredNorm();
      if (square == 0.0) return std::numeric_limits<double>::infinity();
      product *= size * size / square + 1.0;
    }
    return product;
  }

  /// g = ∇m/m
  [[nodiscard]] static Eigen::VectorXd logarithmic_gradient(
      const Eigen::VectorXd& x, double size, const std::vector<Eigen::VectorXd>& known) {
    Eigen::VectorXd g = Eigen::VectorXd::Zero(x.size());
    for (const Eigen::VectorXd& other : known) {
      const Eigen::VectorXd d = x - other;
      const double square = d.squaredNorm();
      g -= 2.0 * size * size / (square * (size * size + square)) * d;
    }
    return g;
  }

  /// No longer on the way to a solution: the merit has not fallen to a half over the last
  /// iterations.
  [[nodiscard]] static bool is_stalled(const std::vector<double>& merits) {
    constexpr std::size_t patience = 8;
    if (!std::isfinite(merits.back())) return true;
    if (merits.size() <= patience) return false;
    return !(merits.back() < 0.5 * merits[merits.size() - 1 - patience]);
  }

  /// Newton's method on the deflated equations. Empty: it did not converge.
  [[nodiscard]] std::optional<Eigen::VectorXd> deflated(Eigen::VectorXd x, double frequency,
                                                        const std::vector<Eigen::VectorXd>& known) {
    if (known.empty()) return std::nullopt;
    double size = 0.0;
    for (const Eigen::VectorXd& other : known) size = std::max(size, other.norm());
    if (size == 0.0) size = natural_scaling(tried(), x, frequency).x;
    const double scale = natural_scaling(tried(), known.front(), frequency).residual;
    for (const Eigen::VectorXd& other : known) {
      if ((x - other).norm() < 1e-2 * size) x *= 1.1;  // m has no value at a known solution
    }
    Eigen::VectorXd residual = tried().residual(x, frequency).residual;
    count(0, 1);
    std::vector<double> merits;
    for (int i = 0; i < most_iterations; ++i) {
      merits.push_back(merit(x, size, known, residual));
      if (residual.norm() <= cheap_tolerance * scale) return x;
      if (is_stalled(merits)) return std::nullopt;
      const BalanceEvaluation at = tried().evaluate(x, frequency);
      Eigen::VectorXd step = -solved(at.jacobian, at.residual);
      step /= 1.0 - logarithmic_gradient(x, size, known).dot(step);
      if (!step.allFinite()) return std::nullopt;
      const double longest = longest_step * std::max(x.norm(), size);
      if (step.norm() > longest) step *= longest / step.norm();
      count(1, 1);
      double length = 1.0;
      for (int k = 0; k <= most_halvings; ++k, length *= 0.5) {
        const Eigen::VectorXd next = x + length * step;
        residual = tried().residual(next, frequency).residual;
        count(0, 1);
        // The last try is taken even if it rises: between regimes no length may do.
        if (merit(next, size, known, residual) < merits.back() || k == most_halvings) {
          x = next;
          break;
        }
      }
    }
    return std::nullopt;
  }

  void keep_branch(NewtonResult start) {
    if (is_point()) {
      SolvedPoint solved = solved_point(*balance_, start, options_);
      curve_.contact_evaluations += solved.evaluations;
      if (!solved.why.empty()) {
        curve_.log.push_back({start.point.parameter, Remedy::row_left_out});
        lacks("a solution left out for its " + solved.why);
        return;
      }
      curve_.detached.push_back({.points = {std::move(solved.point)}});
      return;
    }
    DetachedBranch branch = followed(std::move(start), options_);
    if (!branch.points.empty()) curve_.detached.push_back(std::move(branch));
  }

  /// Both ways from a solution to the ends of its branch.
  [[nodiscard]] DetachedBranch followed(NewtonResult start, const ContinuationOptions& options) {
    ContinuationOptions backward = options;
    std::swap(backward.frequency_begin, backward.frequency_end);
    const ResponseCurve ahead =
        CurveTracer(scene_, options, observer()).follow(start, balance_->set());
    count_work(ahead);
    note_end(ahead);
    DetachedBranch branch;
    branch.closed = ahead.diagnosis == Diagnosis::loop;
    if (!branch.closed) {
      const ResponseCurve back =
          CurveTracer(scene_, backward, observer()).follow(std::move(start), balance_->set());
      count_work(back);
      note_end(back);
      if (!back.points.empty()) {
        branch.points.assign(back.points.rbegin(), back.points.rend() - 1);
      }
    }
    const std::size_t start_at = branch.points.size();
    branch.points.insert(branch.points.end(), ahead.points.begin(), ahead.points.end());
    mark_peak_at(start_at, branch);
    left_ = options_.leave_sampled_walks && is_led_by_errors(branch.points);
    return branch;
  }

  /// Where the walk began no step has seen the slope change its sign.
  static void mark_peak_at(std::size_t i, DetachedBranch& branch) {
    std::vector<ResponsePoint>& points = branch.points;
    if (points.size() < 3 || i + 1 >= points.size() || (i == 0 && !branch.closed)) return;
    ResponsePoint& here = points[i];
    const ResponsePoint& before = i > 0 ? points[i - 1] : points.back();
    const double beside = std::max(before.amplitude, points[i + 1].amplitude);
    if (here.mark == PointMark::none && here.amplitude > beside) here.mark = PointMark::peak;
  }

  void note_end(const ResponseCurve& branch) {
    const bool leaves =
        branch.complete || branch.diagnosis == Diagnosis::out_of_range;  // by an edge
    if (leaves || branch.diagnosis == Diagnosis::loop || branch.points.empty()) return;
    cut_.push_back({branch.points.back().frequency, branch.diagnosis});
  }

  /// Of branches that were followed for where they come back to the one frequency.
  void tell_cut() {
    if (!is_point() || cut_.empty() || is_stopped()) return;
    std::ostringstream text;
    text.precision(6);
    text << (curve_.message.empty() ? "" : "; ")
         << "the branch of a solution was followed no further than "
         << 0.5 * cut_.front().frequency / std::numbers::pi << " Hz ("
         << to_string(cut_.front().diagnosis)
         << "): where else it comes back to this frequency is not known";
    curve_.message += text.str();
  }

  /// A curve that lacks a solution, beside it as well, is not complete.
  void lacks(const std::string& what) {
    curve_.complete = false;
    if (curve_.diagnosis == Diagnosis::none) curve_.diagnosis = Diagnosis::uncertified;
    curve_.message += (curve_.message.empty() ? "" : "; ") + ("beside the curve " + what);
  }

  void count_work(const ResponseCurve& branch) {
    if (branch.diagnosis == Diagnosis::uncertified) lacks(branch.message);
    curve_.iterations += branch.iterations;
    curve_.contact_evaluations += branch.contact_evaluations;
    std::ranges::copy_if(branch.log, std::back_inserter(curve_.log), [](const SolverEvent& event) {
      return event.remedy == Remedy::row_left_out;
    });
  }

  const Scene& scene_;
  const ContinuationOptions& options_;
  ResponseCurve& curve_;
  std::unique_ptr<HarmonicBalance> balance_;
  std::unique_ptr<HarmonicBalance> cheap_;  // with the scene of a search, if there is one
  bool left_ = false;  ///< a branch, for the errors of forces: all is looked for again without
  struct Cut {
    double frequency;
    Diagnosis diagnosis;
  };
  std::vector<Cut> cut_;  // ends of branches within their range
  struct CurveBeside {
    ContinuationOptions range;
    ResponseCurve curve;
  };
  std::vector<CurveBeside> beside_;  // from resonances beside the range into it
};

}  // namespace

void search_branches(const Scene& scene, const ContinuationOptions& options, ResponseCurve& curve) {
  if (scene.contact) Search(scene, options, curve).run();
}

}  // namespace microslip::solver
