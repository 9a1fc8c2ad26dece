#include "solver/branch/start_point.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "solver/branch/branch_walker.hpp"

namespace microslip::solver {
namespace {

constexpr int homotopy_steps = 2000;
// Where rounding errors are larger than this share of the forces, no digits are left that could be
// called a solution: the iteration is to fail there.
constexpr double coarsest = 1e-7;

struct Guess {
  const char* name;
  Eigen::MatrixXd stiffness;
  Eigen::VectorXd x;
};

std::vector<Guess> guesses(const HarmonicBalance& balance, double frequency) {
  const Eigen::Index n = balance.scene().n_modes();
  std::vector<Guess> list;
  list.push_back({"stuck", balance.stuck_stiffness(), {}});
  list.push_back({"free", Eigen::MatrixXd::Zero(n, n), {}});
  for (Guess& guess : list) {
    guess.x = balance.linear_response(frequency, guess.stiffness);
    // A resonance without damping, or a floating mode under a mean force, has no linear response.
    if (!guess.x.allFinite()) guess.x = Eigen::VectorXd::Zero(balance.size());
  }
  return list;
}

/// Follows the solutions from the linear limit (λ = 0) to the contact (λ = 1).
NewtonResult follow_homotopy(HarmonicBalance& balance, const Guess& guess, double frequency,
                             const NewtonOptions& options, const std::function<bool()>& stop,
                             StartPoint& count) {
  const ParametricSystem system = [&](const Eigen::VectorXd& x, double share) {
    return balance.evaluate_homotopy(x, frequency, share, guess.stiffness);
  };
  const ScalingRule rule = [&](const NewtonResult& at) {
    return natural_scaling(balance, at.point.x, frequency);
  };
  NewtonResult first =
      solve_newton(system, {guess.x, 0.0}, natural_scaling(balance, guess.x, frequency), options);
  count.evaluations += first.evaluations;
  if (!first.converged) return first;
  BranchWalker walker(system, rule, std::move(first), 1.0);
  NewtonResult last;
  for (int i = 0; i < homotopy_steps && !stop() && walker.advance(); ++i) {
    const double before = walker.before().solution.point.parameter;
    const double now = walker.now().solution.point.parameter;
    if (now < -1.0) break;
    if (now < 1.0) continue;
    last = walker.at_parameter(1.0, (1.0 - before) / (now - before));
    break;
  }
  count.evaluations += walker.evaluations();
  count.iterations += walker.iterations();
  if (!last.converged) return last;
  return solve_at(balance, last.point.x, frequency, options);
}

}  // namespace

Scaling natural_scaling(const HarmonicBalance& balance, const Eigen::VectorXd& x,
                        double frequency) {
  Scaling scaling;
  scaling.residual = balance.force_scale(frequency);
  scaling.x = x.norm();
  if (scaling.residual == 0.0) scaling.residual = 1.0;
  if (scaling.x == 0.0 || !std::isfinite(scaling.x)) {
    const double stiffness = balance.scene().natural_frequency.cwiseAbs2().maxCoeff();
    scaling.x = stiffness > 0.0 ? scaling.residual / stiffness : 1.0;
  }
  scaling.rounding = std::numeric_limits<double>::epsilon() * balance.largest_terms(x, frequency) /
                     scaling.residual;
  if (!std::isfinite(scaling.rounding)) scaling.rounding = 0.0;
  scaling.rounding = std::min(scaling.rounding, coarsest);
  return scaling;
}

NewtonResult solve_at(HarmonicBalance& balance, const Eigen::VectorXd& guess, double frequency,
                      const NewtonOptions& options) {
  const ParametricSystem system = [&](const Eigen::VectorXd& x, double omega) {
    return balance.evaluate(x, omega);
  };
  return solve_newton(system, {guess, frequency}, natural_scaling(balance, guess, frequency),
                      options);
}

StartPoint find_start(HarmonicBalance& balance, double frequency, double tolerance,
                      const Harmonics* near, const std::function<bool()>& stop) {
  const std::function<bool()> stops = stop ? stop : [] { return false; };
  StartPoint start;
  NewtonOptions options;
  options.tolerance = tolerance;
  options.max_iterations = 40;
  const auto list = guesses(balance, frequency);
  const auto accept = [&](NewtonResult result, const std::string& way) {
    start.evaluations += result.evaluations;
    start.iterations += result.iterations;
    start.way += start.way.empty() ? way : ", " + way;
    if (result.converged) start.solution = std::move(result);
    return start.solution.has_value();
  };
  if (near != nullptr && near->rows().cols() == balance.scene().n_modes() &&
      accept(solve_at(balance, balance.unknowns(*near), frequency, options),
             "Newton from a motion near by")) {
    return start;
  }
  for (const Guess& guess : list) {
    if (options.stop != nullptr && stops()) break;
    if (accept(solve_at(balance, guess.x, frequency, options),
               std::string("Newton from the ") + guess.name + " response")) {
      return start;
    }
    options.stop = &stops;  // where the first is enough a curve has a point, however little time
  }
  start.is_stopped = stops();
  if (!balance.scene().contact || start.is_stopped) return start;
  for (const Guess& guess : list) {
    if (accept(follow_homotopy(balance, guess, frequency, options, stops, start),
               std::string("homotopy from the ") + guess.name + " response")) {
      return start;
    }
  }
  start.is_stopped = stops();
  return start;
}

}  // namespace microslip::solver
