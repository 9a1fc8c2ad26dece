#include "solver/balance/few_jacobians.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace microslip::solver {
namespace {

constexpr int most_updates = 8;
constexpr int most_jacobians = 3;
constexpr double falls = 0.3;  // a residual that falls by less asks for a Jacobian of its own
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

  NewtonResult run(const BranchVector& start) {
    NewtonResult at = evaluated(system_.whole, start);
    for (int i = 0; i < most_jacobians && at.residual <= far; ++i) {
      if (at.residual <= tolerance_) return finished(std::move(at));
      NewtonResult best = approached(at);
      if (best.residual <= tolerance_ && at.residual <= near) {
        best.evaluation.jacobian = std::move(at.evaluation.jacobian);
        best.evaluation.parameter_derivative = std::move(at.evaluation.parameter_derivative);
        best.tangent = std::move(tangent_);
        return finished(std::move(best));
      }
      if (!(best.residual < at.residual)) break;  // a kink: for Newton's method
      at = evaluated(system_.whole, std::move(best.point));
    }
    if (at.residual <= tolerance_) return finished(std::move(at));
    NewtonResult result = solve_newton(system_, std::move(at), constraint_, scaling_, options_);
    result.iterations += iterations_;
    result.evaluations += evaluations_;
    return result;
  }

 private:
  [[nodiscard]] NewtonResult finished(NewtonResult at) const {
    at.converged = true;
    at.iterations = iterations_;
    at.evaluations = evaluations_;
    return at;
  }

  [[nodiscard]] Eigen::VectorXd step(const contact::LuFactors& factors,
                                     const BalanceEvaluation& at) const {
    Eigen::VectorXd right(at.residual.size() + 1);
    right << -at.residual / scaling_.residual, 0.0;
    return factors.solve(right);
  }

  [[nodiscard]] BranchVector moved(const BranchVector& from, const Eigen::VectorXd& scaled) const {
    const Eigen::Index n = from.x.size();
    return {from.x + scaling_.x * scaled.head(n), from.parameter + scaling_.parameter * scaled[n]};
  }

  [[nodiscard]] NewtonResult evaluated(const ParametricSystem& system, BranchVector point) {
    ++evaluations_;
    return evaluated_at(system, std::move(point), scaling_);
  }

  /// Broyden's method by forces alone from a point with its Jacobian: the best point met.
  [[nodiscard]] NewtonResult approached(const NewtonResult& from) {
    const contact::LuFactors factors(bordered(from.evaluation, constraint_, scaling_));
    tangent_ = branch_tangent(factors, constraint_);
    std::vector<Eigen::VectorXd> steps;
    NewtonResult best;
    best.point = from.point;
    best.residual = from.residual;
    const BalanceEvaluation* here = &from.evaluation;
    for (int i = 0; i < most_updates; ++i) {
      Eigen::VectorXd next = step(factors, *here);
      for (std::size_t j = 0; j + 1 < steps.size(); ++j) {
        next += steps[j + 1] * (steps[j].dot(next) / steps[j].squaredNorm());
      }
      if (!steps.empty()) next /= 1.0 - steps.back().dot(next) / steps.back().squaredNorm();
      if (!next.allFinite()) return best;
      NewtonResult trial = evaluated(system_.residual, moved(best.point, next));
      ++iterations_;
      const bool fell = trial.residual < falls * best.residual;
      if (trial.residual < best.residual) best = std::move(trial);
      if (!fell || best.residual <= tolerance_) return best;
      here = &best.evaluation;
      steps.push_back(std::move(next));
    }
    return best;
  }

  const EconomicSystem& system_;
  const BranchVector& constraint_;
  const Scaling& scaling_;
  const NewtonOptions& options_;
  double tolerance_;
  std::optional<Tangent> tangent_;  // at the last Jacobian that was factorised
  int iterations_ = 0;
  int evaluations_ = 0;
};

}  // namespace

NewtonResult solve_with_few_jacobians(const EconomicSystem& system, const BranchVector& start,
                                      const BranchVector& constraint, const Scaling& scaling,
                                      const NewtonOptions& options) {
  return Corrector(system, constraint, scaling, options).run(start);
}

NewtonResult solve_balance(HarmonicBalance& balance, ContinuationOptions::Corrector corrector,
                           const BranchVector& guess, const BranchVector& constraint,
                           const Scaling& scaling, const NewtonOptions& options) {
  const ParametricSystem whole = [&](const Eigen::VectorXd& x, double frequency) {
    return balance.evaluate(x, frequency);
  };
  if (corrector == ContinuationOptions::Corrector::newton) {
    return solve_newton(whole, guess, constraint, scaling, options);
  }
  const ParametricSystem residual = [&](const Eigen::VectorXd& x, double frequency) {
    return balance.residual(x, frequency);
  };
  return solve_with_few_jacobians({whole, residual}, guess, constraint, scaling, options);
}

}  // namespace microslip::solver
