#include "solver/point_shift.hpp"

#include <cmath>

#include "solver/balance/condensed.hpp"
#include "solver/balance/first_harmonics.hpp"
#include "solver/balance/newton.hpp"
#include "solver/balance/output_amplitude.hpp"
#include "solver/branch/start_point.hpp"

namespace microslip::solver {

std::optional<PointShift> point_shift(const Scene& scene, const ResponsePoint& point) {
  HarmonicBalance balance(scene, HarmonicSet(point.orders));
  const Eigen::VectorXd x = balance.unknowns(point.q);
  const Scaling scaling = natural_scaling(balance, x, point.frequency);
  const BalanceEvaluation at = balance.evaluate(x, point.frequency);
  const std::optional<BranchVector> along = null_vector(at, scaling, 1.0);
  if (!along || !(point.amplitude > 0.0)) return std::nullopt;
  const BranchVector step = newton_step(at, *along, scaling);
  if (!step.x.allFinite() || !std::isfinite(step.parameter)) return std::nullopt;
  const OutputAmplitude output = output_amplitude(balance.harmonics(x), scene.output);
  const Eigen::VectorXd gradient = balance.unknowns(output.gradient);
  return PointShift{step.parameter / point.frequency, gradient.dot(step.x) / point.amplitude};
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
