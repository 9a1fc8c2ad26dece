#include "solver/mark_shift.hpp"

#include "solver/balance/newton.hpp"
#include "solver/balance/output_amplitude.hpp"
#include "solver/branch/start_point.hpp"

namespace microslip::solver {

std::optional<MarkShift> mark_shift(const Scene& scene, const ResponsePoint& mark) {
  HarmonicBalance balance(scene, HarmonicSet(mark.orders));
  const Eigen::VectorXd x = balance.unknowns(mark.q);
  const Scaling scaling = natural_scaling(balance, x, mark.frequency);
  const BalanceEvaluation at = balance.evaluate(x, mark.frequency);
  const std::optional<BranchVector> along = null_vector(at, scaling, 1.0);
  if (!along || !(mark.amplitude > 0.0)) return std::nullopt;
  const Eigen::Index n = x.size();
  Eigen::VectorXd right(n + 1);
  right << -at.residual / scaling.residual, 0.0;
  const Eigen::VectorXd step = contact::solved(bordered(at, *along, scaling), right);
  if (!step.allFinite()) return std::nullopt;
  const OutputAmplitude output = output_amplitude(balance.harmonics(x), scene.output);
  const Eigen::VectorXd gradient = balance.unknowns(output.gradient);
  return MarkShift{scaling.parameter * step[n] / mark.frequency,
                   scaling.x * gradient.dot(step.head(n)) / mark.amplitude};
}

}  // namespace microslip::solver
