#include "solver/enrichment/dropped_harmonics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "contact/dense.hpp"
#include "solver/balance/condensed.hpp"
#include "solver/balance/output_amplitude.hpp"
#include "solver/enrichment/enrichment.hpp"

namespace microslip::solver {

std::vector<DroppedHarmonic> dropped_harmonics(HarmonicBalance& balance, const LocalPeak& peak) {
  const BalanceEvaluation at = balance.evaluate(peak.point.x, peak.point.parameter);
  const Scaling& scaling = peak.scaling;
  const Eigen::Index n = peak.point.x.size();
  const BorderedFactors factors(at, border_of(peak), scaling);
  const OutputAmplitude output =
      output_amplitude(balance.harmonics(peak.point.x), balance.scene().output);
  Eigen::VectorXd goal = Eigen::VectorXd::Zero(n + 1);
  goal.head(n) = balance.unknowns(output.gradient);
  const Eigen::VectorXd adjoint = factors.solve_transposed(goal);
  std::vector<DroppedHarmonic> result;
  const Eigen::Index size = 2 * balance.scene().n_modes();
  Eigen::Index first = balance.orders_begin();
  for (const int order : balance.set().orders()) {
    Eigen::MatrixXd unit = Eigen::MatrixXd::Zero(n + 1, size);
    unit.middleRows(first, size).setIdentity();
    const Eigen::MatrixXd own = factors.solve(unit).middleRows(first, size);
    const Eigen::VectorXd force = contact::solved(own, -peak.point.x.segment(first, size));
    const double change = adjoint.segment(first, size).dot(force) / output.half_peak_to_peak;
    result.push_back(
        {order, std::isfinite(change) ? change : std::numeric_limits<double>::infinity()});
    first += size;
  }
  std::ranges::stable_sort(result, {},
                           [](const DroppedHarmonic& one) { return std::abs(one.amplitude); });
  return result;
}

}  // namespace microslip::solver
