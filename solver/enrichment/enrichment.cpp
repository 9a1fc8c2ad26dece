#include "solver/enrichment/enrichment.hpp"

#include "solver/balance/condensed.hpp"
#include "solver/balance/output_amplitude.hpp"

namespace microslip::solver {

BranchVector border_of(const LocalPeak& peak) {
  if (peak.place != PeakPlace::range_end) return peak.tangent;
  return {Eigen::VectorXd::Zero(peak.tangent.x.size()), 1.0};
}

LocalPeak embedded(const LocalPeak& peak, const HarmonicBalance& coarse,
                   const HarmonicBalance& richer) {
  LocalPeak result = peak;
  result.point.x = richer.unknowns(coarse.harmonics(peak.point.x));
  result.tangent.x = richer.unknowns(coarse.harmonics(peak.tangent.x));
  return result;
}

std::vector<RicherShare> richer_shares(HarmonicBalance& richer, const LocalPeak& peak) {
  const Eigen::Index size = peak.point.x.size();
  const Scaling& scaling = peak.scaling;
  const BalanceEvaluation at = richer.evaluate(peak.point.x, peak.point.parameter);
  const Eigen::VectorXd residual = at.residual / scaling.residual;
  const OutputAmplitude output =
      output_amplitude(richer.harmonics(peak.point.x), richer.scene().output);
  const BranchVector border = border_of(peak);
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(size + 1);
  gradient.head(size) = scaling.x * richer.unknowns(output.gradient);
  const Eigen::VectorXd adjoint = BorderedFactors(at, border, scaling).solve_transposed(gradient);
  std::vector<RicherShare> shares;
  const bool counts = output.half_peak_to_peak > 0.0;
  if (!counts || !adjoint.allFinite() || !residual.allFinite()) return shares;
  const auto add = [&](int order, Eigen::Index first, Eigen::Index count) {
    const double change = -adjoint.segment(first, count).dot(residual.segment(first, count));
    shares.push_back({order, change / output.half_peak_to_peak});
  };
  const Eigen::Index n = richer.scene().n_modes();
  Eigen::Index first = richer.orders_begin();
  if (first > 0) add(0, 0, n);
  for (const int order : richer.set().orders()) {
    add(order, first, 2 * n);
    first += 2 * n;
  }
  return shares;
}

}  // namespace microslip::solver
