#include "solver/point_shift.hpp"

#include <cmath>

#include "solver/balance/condensed.hpp"
#include "solver/balance/few_jacobians.hpp"
#include "solver/balance/first_harmonics.hpp"
#include "solver/balance/newton.hpp"
#include "solver/balance/output_amplitude.hpp"
#include "solver/branch/start_point.hpp"

namespace microslip::solver {
namespace {

struct StepAcross {
  BranchVector step;
  BranchVector along;  ///< the direction of the branch, in scaled variables
};

/// Newton's step without its part along the branch, by one set of factors; near a fold, where the
/// frequency is no border of them, by those that the branch's direction borders.
StepAcross step_across(const BalanceEvaluation& at, const Scaling& scaling) {
  constexpr double least_part = 1e-3;  // of the direction, that is the frequency
  const Eigen::Index n = at.residual.size();
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(n + 1, 2);
  right.col(0).head(n) = -at.residual / scaling.residual;
  right(n, 1) = 1.0;
  BranchVector row{Eigen::VectorXd::Zero(n), 1.0};
  Eigen::VectorXd step;
  for (int i = 0; i < 2; ++i) {
    const Eigen::MatrixXd both = BorderedFactors(at, row, scaling).solve(right);
    const Eigen::VectorXd direction = both.col(1).normalized();
    step = both.col(0) - both.col(0).dot(direction) * direction;
    row = {direction.head(n), direction[n]};
    if (i == 0 && std::abs(direction[n]) > least_part) break;
  }
  return {{step.head(n) * scaling.x, step[n] * scaling.parameter}, row};
}

/// Where the step tells more than this, Newton's method goes on across the branch.
struct LongStep {
  double amplitude;
  double frequency;
};
constexpr LongStep long_step{1e-2, 1e-4};

/// The place where the plane across the branch meets that of the other model; empty: not found.
std::optional<PointShift> solved_shift(HarmonicBalance& balance, const ResponsePoint& point,
                                       const BranchVector& along, const Scaling& scaling) {
  constexpr NewtonOptions options{.tolerance = 1e-8, .max_iterations = 8, .max_evaluations = 24};
  const NewtonResult there =
      solve_balance(balance, ContinuationOptions::Corrector::few_jacobians,
                    {balance.unknowns(point.q), point.frequency}, along, scaling, options);
  if (!there.converged) return std::nullopt;
  const double amplitude =
      output_amplitude(balance.harmonics(there.point.x), balance.scene().output).half_peak_to_peak;
  return PointShift{there.point.parameter / point.frequency - 1.0,
                    amplitude / point.amplitude - 1.0};
}

}  // namespace

std::optional<PointShift> point_shift(const Scene& scene, const ResponsePoint& point) {
  return point_shift(scene, HarmonicSet(point.orders), point, false);
}

std::optional<PointShift> point_shift(const Scene& scene, const HarmonicSet& set,
                                      const ResponsePoint& point, bool solve) {
  HarmonicBalance balance(scene, set);
  const Eigen::VectorXd x = balance.unknowns(point.q);
  const Scaling scaling = natural_scaling(balance, x, point.frequency);
  const BalanceEvaluation at = balance.evaluate(x, point.frequency);
  if (!(point.amplitude > 0.0)) return std::nullopt;
  const auto [step, along] = step_across(at, scaling);
  if (!step.x.allFinite() || !std::isfinite(step.parameter)) return std::nullopt;
  const OutputAmplitude output = output_amplitude(balance.harmonics(x), scene.output);
  const Eigen::VectorXd gradient = balance.unknowns(output.gradient);
  const PointShift told{step.parameter / point.frequency, gradient.dot(step.x) / point.amplitude};
  const bool is_long = std::abs(told.amplitude) > long_step.amplitude ||
                       std::abs(told.frequency) > long_step.frequency;
  return solve && is_long ? solved_shift(balance, point, along, scaling) : told;
}

std::optional<double> amplitude_shift(const Scene& scene, const ContinuationOptions& range,
                                      const ResponsePoint& point) {
  HarmonicBalance balance(scene, first_harmonics(scene, range).united(point.orders));
  const Eigen::VectorXd x = balance.unknowns(point.q);
  const BalanceEvaluation at = balance.evaluate(x, point.frequency);
  const Eigen::VectorXd step = -solved(at.jacobian, at.residual);
  if (!step.allFinite() || !(point.amplitude > 0.0)) return std::nullopt;
  const OutputAmplitude output = output_amplitude(balance.harmonics(x), scene.output);
  return balance.unknowns(output.gradient).dot(step) / point.amplitude;
}

}  // namespace microslip::solver
