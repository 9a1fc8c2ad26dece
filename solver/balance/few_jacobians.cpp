#include "solver/balance/few_jacobians.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "solver/balance/broyden.hpp"

namespace microslip::solver {
namespace {

constexpr int most_updates = 10;
constexpr int most_jacobians = 3;
constexpr double falls = 0.3;  // a residual that falls by less asks for a Jacobian of its own
// From factors of another place a step may lead away before the next leads on.
constexpr double falls_from_afar = 0.7;
constexpr double rises_from_afar = 4.0;
constexpr int most_astray = 3;
// Residuals over the scale of forces:
constexpr double far = 3e-2;  // no place for a chord
constexpr double near =
    3e-4;  // from here to the solution derivatives change by less than a plot shows

class Corrector {
 public:
  Corrector(const EconomicSystem& system, const BranchVector& constraint, const Scaling& scaling,
            const NewtonOptions& options)
      : system_(system),
        constraint_(constraint),
        scaling_(scaling),
        options_(options),
        tolerance_(std::max(options.tolerance, scaling.rounding)) {}

  NewtonResult run(const BranchVector& start, const BranchFactors* nearby) {
    NewtonResult at = nearby != nullptr ? brought_near(start, *nearby) : evaluated(start);
    for (int i = 0; i < most_jacobians && at.residual <= far; ++i) {
      if (at.residual <= tolerance_) return solution(std::move(at));
      if (options_.is_stopped()) break;
      NewtonResult best = approached(at);
      if (best.residual <= tolerance_ && at.residual <= near) {
        best.evaluation.jacobian = std::move(at.evaluation.jacobian);
        best.evaluation.parameter_derivative = std::move(at.evaluation.parameter_derivative);
        best.factors = std::move(factors_);
        return finished(std::move(best));
      }
      if (!(best.residual < at.residual)) break;  // a kink: for Newton's method
      at = evaluated(std::move(best.point));
    }
    if (at.residual <= tolerance_) return solution(std::move(at));
    if (options_.max_iterations == 0) {
      at.iterations = iterations_;
      at.evaluations = evaluations_;
      return at;
    }
    NewtonResult result = solve_newton(system_, std::move(at), constraint_, scaling_, options_);
    result.iterations += iterations_;
    result.evaluations += evaluations_;
    return result;
  }

 private:
  /// With factors of its own Jacobian, which tangent, slope and stability ask for in turn.
  [[nodiscard]] NewtonResult solution(NewtonResult at) const {
    at.factors = std::make_shared<BranchFactors>(at.evaluation, constraint_, scaling_);
    return finished(std::move(at));
  }

  [[nodiscard]] NewtonResult finished(NewtonResult at) const {
    at.converged = true;
    at.iterations = iterations_;
    at.evaluations = evaluations_;
    return at;
  }

  [[nodiscard]] NewtonResult evaluated(BranchVector point) {
    ++evaluations_;
    return evaluated_at(system_.whole, std::move(point), scaling_);
  }

  [[nodiscard]] NewtonResult with_force(BranchVector point) {
    ++evaluations_;
    return evaluated_at(system_.residual, std::move(point), scaling_);
  }

  [[nodiscard]] std::optional<NewtonResult> stepped(Broyden& method, const NewtonResult& from) {
    const Eigen::Index n = from.point.x.size();
    Eigen::VectorXd f(n + 1);
    f << from.evaluation.residual / scaling_.residual, 0.0;
    const Eigen::VectorXd step = method.step(f);
    if (!step.allFinite()) return std::nullopt;
    ++iterations_;
    return with_force({from.point.x + scaling_.x * step.head(n),
                       from.point.parameter + scaling_.parameter * step[n]});
  }

  /// Where derivatives are worth their price: as near as factors of another place lead.
  [[nodiscard]] NewtonResult brought_near(const BranchVector& start, const BranchFactors& nearby) {
    Broyden method(
        [&](const Eigen::VectorXd& f) { return nearby.solve(f, constraint_, scaling_); });
    NewtonResult best = with_force(start);
    NewtonResult here = best;
    int astray = 0;
    for (int i = 0; i < most_updates && best.residual > near && astray < most_astray; ++i) {
      std::optional<NewtonResult> next = stepped(method, here);
      if (!next || !(next->residual < rises_from_afar * best.residual)) break;
      if (options_.is_stopped()) break;
      here = std::move(*next);
      astray = here.residual < falls_from_afar * best.residual ? 0 : astray + 1;
      if (here.residual < best.residual) best = here;
    }
    const bool lost = best.residual > far && options_.max_iterations == 0;
    return lost ? best : evaluated(std::move(best.point));
  }

  /// Broyden's method by forces alone from a point with its Jacobian: the best point met.
  [[nodiscard]] NewtonResult approached(const NewtonResult& from) {
    factors_ = std::make_shared<BranchFactors>(from.evaluation, constraint_, scaling_);
    Broyden method(
        [&](const Eigen::VectorXd& f) { return factors_->solve(f, constraint_, scaling_); });
    NewtonResult best;
    best.point = from.point;
    best.residual = from.residual;
    best.evaluation.residual = from.evaluation.residual;
    for (int i = 0; i < most_updates; ++i) {
      std::optional<NewtonResult> trial = stepped(method, best);
      if (!trial) return best;
      const bool fell = trial->residual < falls * best.residual;
      if (trial->residual < best.residual) best = std::move(*trial);
      if (!fell || best.residual <= tolerance_) return best;
    }
    return best;
  }

  const EconomicSystem& system_;
  const BranchVector& constraint_;
  const Scaling& scaling_;
  const NewtonOptions& options_;
  double tolerance_;
  std::shared_ptr<BranchFactors> factors_;  // of the last Jacobian that was factorised
  int iterations_ = 0;
  int evaluations_ = 0;
};

}  // namespace

NewtonResult solve_with_few_jacobians(const EconomicSystem& system, const BranchVector& start,
                                      const BranchVector& constraint, const Scaling& scaling,
                                      const NewtonOptions& options, const BranchFactors* nearby) {
  return Corrector(system, constraint, scaling, options).run(start, nearby);
}

NewtonResult solve_balance(HarmonicBalance& balance, ContinuationOptions::Corrector corrector,
                           const BranchVector& guess, const BranchVector& constraint,
                           const Scaling& scaling, const NewtonOptions& options,
                           const BranchFactors* nearby) {
  const ParametricSystem whole = [&](const Eigen::VectorXd& x, double frequency) {
    return balance.evaluate(x, frequency);
  };
  if (corrector == ContinuationOptions::Corrector::newton) {
    return solve_newton(whole, guess, constraint, scaling, options);
  }
  const ParametricSystem residual = [&](const Eigen::VectorXd& x, double frequency) {
    return balance.residual(x, frequency);
  };
  return solve_with_few_jacobians({whole, residual}, guess, constraint, scaling, options, nearby);
}

}  // namespace microslip::solver
