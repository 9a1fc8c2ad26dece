#include "solver/balance/newton.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "contact/dense.hpp"
#include "solver/balance/branch_factors.hpp"
#include "solver/balance/condensed.hpp"

namespace microslip::solver {
namespace {

constexpr int max_halvings = 7;
constexpr int max_polish = 4;
constexpr double polished_below = 5e-11;  // a tolerance above asks for no more than it says
constexpr double rounding_level = 1e-14;  // a shorter step cannot help any more

class Iteration {
 public:
  /// @param shortened  what steps of the line search are judged by; of `system`,
  ///                   or with its residual alone.
  Iteration(const ParametricSystem& system, const ParametricSystem& shortened,
            const BranchVector& constraint, const Scaling& scaling)
      : system_(system), shortened_(shortened), constraint_(constraint), scaling_(scaling) {}

  NewtonResult run(NewtonResult start, const NewtonOptions& options) {
    now_ = std::move(start);
    const double tolerance = std::max(options.tolerance, scaling_.rounding);
    for (int i = 0; i < options.max_iterations && now_.residual > tolerance; ++i) {
      if (options.is_stopped() || now_.evaluations >= options.max_evaluations) break;
      if (!step(i)) break;
      ++now_.iterations;
    }
    now_.converged = now_.residual <= tolerance;
    if (now_.converged && options.tolerance < polished_below) {
      polish(std::max(options.polished_to, scaling_.rounding));
    }
    return std::move(now_);
  }

 private:
  void move_to(NewtonResult next) {
    next.iterations = now_.iterations;
    next.evaluations = now_.evaluations;
    now_ = std::move(next);
  }

  [[nodiscard]] NewtonResult stepped(const ParametricSystem& system, const BranchVector& step,
                                     double length) {
    ++now_.evaluations;
    return evaluated_at(
        system, {now_.point.x + length * step.x, now_.point.parameter + length * step.parameter},
        scaling_);
  }

  /// A point with its derivatives, where it has been met by its residual alone.
  [[nodiscard]] NewtonResult whole(NewtonResult at) {
    if (!at.evaluation.jacobian.empty()) return at;
    ++now_.evaluations;
    return evaluated_at(system_, std::move(at.point), scaling_);
  }

  /// Backtracks until the residual falls. Between two regimes no length may do: then a shortened
  /// step is taken all the same, a few times, to leave the kink.
  bool step(int iteration) {
    if (!std::isfinite(now_.residual)) return false;
    const BranchVector direction = newton_step(now_.evaluation, constraint_, scaling_);
    if (!direction.x.allFinite() || !std::isfinite(direction.parameter)) return false;
    double length = 1.0;
    NewtonResult fallback;
    fallback.residual = std::numeric_limits<double>::infinity();
    for (int i = 0; i <= max_halvings; ++i, length *= 0.5) {
      NewtonResult next = stepped(i == 0 ? system_ : shortened_, direction, length);
      if (next.residual < (1.0 - 0.1 * length) * now_.residual) {
        next = whole(std::move(next));
        if (std::isfinite(next.residual)) {
          move_to(std::move(next));
          return true;
        }
      }
      if (next.residual < fallback.residual) fallback = std::move(next);
    }
    const bool may_rise = iteration % 3 != 2 && fallback.residual < 4.0 * now_.residual;
    if (!may_rise && !(fallback.residual < now_.residual)) return false;
    move_to(whole(std::move(fallback)));
    return true;
  }

  /// Goes on while the residual falls; near a kink a shorter step may do what the whole one does
  /// not.
  void polish(double to) {
    for (int i = 0; i < max_polish && now_.residual > to; ++i) {
      const BranchVector direction = newton_step(now_.evaluation, constraint_, scaling_);
      if (!direction.x.allFinite() || !std::isfinite(direction.parameter)) return;
      const double before = now_.residual;
      for (const double length : {1.0, 0.5, 0.1}) {
        NewtonResult next = stepped(system_, direction, length);
        if (next.residual < now_.residual) {
          keep(std::move(next));
          break;
        }
        if (now_.residual < rounding_level) return;
      }
      if (now_.residual > 0.7 * before) return;
    }
  }

  void keep(NewtonResult next) {
    next.converged = true;
    move_to(std::move(next));
  }

  const ParametricSystem& system_;
  const ParametricSystem& shortened_;
  const BranchVector& constraint_;
  const Scaling& scaling_;
  NewtonResult now_;
};

}  // namespace

Eigen::MatrixXd bordered(const BalanceEvaluation& at, const BranchVector& row,
                         const Scaling& scaling) {
  const Eigen::Index n = at.residual.size();
  Eigen::MatrixXd matrix(n + 1, n + 1);
  matrix.topLeftCorner(n, n) = at.jacobian.dense() * (scaling.x / scaling.residual);
  matrix.topRightCorner(n, 1) = at.parameter_derivative * (scaling.parameter / scaling.residual);
  matrix.bottomLeftCorner(1, n) = row.x.transpose();
  matrix(n, n) = row.parameter;
  return matrix;
}

NewtonResult evaluated_at(const ParametricSystem& system, BranchVector point,
                          const Scaling& scaling) {
  NewtonResult result;
  result.point = std::move(point);
  result.evaluation = system(result.point.x, result.point.parameter);
  // A residual that is not known cannot be small.
  const double size = result.evaluation.residual.norm() + result.evaluation.defect;
  result.residual = std::isfinite(size) && result.evaluation.jacobian.all_finite() &&
                            result.evaluation.parameter_derivative.allFinite()
                        ? size / scaling.residual
                        : std::numeric_limits<double>::infinity();
  return result;
}

NewtonResult solve_newton(const ParametricSystem& system, NewtonResult start,
                          const BranchVector& constraint, const Scaling& scaling,
                          const NewtonOptions& options) {
  start.iterations = start.evaluations = 0;
  return Iteration(system, system, constraint, scaling).run(std::move(start), options);
}

NewtonResult solve_newton(const EconomicSystem& system, NewtonResult start,
                          const BranchVector& constraint, const Scaling& scaling,
                          const NewtonOptions& options) {
  start.iterations = start.evaluations = 0;
  return Iteration(system.whole, system.residual, constraint, scaling)
      .run(std::move(start), options);
}

NewtonResult solve_newton(const ParametricSystem& system, const BranchVector& start,
                          const BranchVector& constraint, const Scaling& scaling,
                          const NewtonOptions& options) {
  NewtonResult result =
      solve_newton(system, evaluated_at(system, start, scaling), constraint, scaling, options);
  ++result.evaluations;
  return result;
}

NewtonResult solve_newton(const ParametricSystem& system, const BranchVector& start,
                          const Scaling& scaling, const NewtonOptions& options) {
  const BranchVector hold{Eigen::VectorXd::Zero(start.x.size()), 1.0};
  return solve_newton(system, start, hold, scaling, options);
}

namespace {

/// By two bordered systems, the second bordered by what the first has found.
std::optional<BranchVector> condensed_null_vector(const BalanceEvaluation& at,
                                                  const Scaling& scaling, double orientation) {
  const Eigen::Index n = at.residual.size();
  const Eigen::VectorXd unit = Eigen::VectorXd::Unit(n + 1, n);
  BranchVector row{Eigen::VectorXd::Zero(n), 1.0};
  double sign = 0.0;
  for (int i = 0; i < 2; ++i) {
    const BorderedFactors factors(at, row, scaling);
    const Eigen::VectorXd y = factors.solve(unit);
    if (!y.allFinite()) return std::nullopt;
    const double size = y.norm();
    const BranchVector found{y.head(n) / size, y[n] / size};
    constexpr double rounded = 1e-6;
    const bool moved = found.x.dot(row.x) + found.parameter * row.parameter < 1.0 - rounded;
    if (i > 0 && moved) return std::nullopt;  // more than one direction
    row = found;
    sign = factors.sign_of_determinant();
  }
  if (sign * orientation < 0.0) row = {-row.x, -row.parameter};
  return row;
}

}  // namespace

std::optional<BranchVector> null_vector(const BalanceEvaluation& at, const Scaling& scaling,
                                        double orientation) {
  if (at.jacobian.parts() != nullptr) {
    if (auto found = condensed_null_vector(at, scaling, orientation)) return found;
  }
  const Eigen::Index n = at.residual.size();
  const BranchVector none{Eigen::VectorXd::Zero(n), 0.0};
  Eigen::MatrixXd square = bordered(at, none, scaling);
  if (!square.allFinite()) return std::nullopt;
  std::optional<Eigen::VectorXd> y = contact::null_direction(square.topRows(n));
  if (!y) return std::nullopt;
  square.row(n) = y->transpose();
  if (contact::LuFactors(square).sign_of_determinant() * orientation < 0.0) *y = -*y;
  return BranchVector{y->head(n), (*y)[n]};
}

Tangent branch_tangent(const BalanceEvaluation& at, const BranchVector& previous,
                       const Scaling& scaling) {
  return BranchFactors(at, previous, scaling).tangent();
}

}  // namespace microslip::solver
