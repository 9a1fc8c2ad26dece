#include "pipelines/response/run_summary.hpp"

#include <cmath>
#include <limits>

#include "pipelines/response/highest_peak.hpp"

namespace microslip::pipelines {
namespace {

std::optional<double> entry(const Eigen::VectorXd& column, Eigen::Index row) {
  if (row >= column.size()) return std::nullopt;
  return column[row];
}

void add_point(CurveSummary& summary, const solver::ResponsePoint& point) {
  if (point.mark == solver::PointMark::peak) {
    summary.peaks.push_back({point.frequency, point.amplitude, point.energy.friction});
  }
  if (point.mark == solver::PointMark::fold) summary.folds.push_back(point.frequency);
  // A value that is not a number is worse than any: it stays, and is null in the file.
  const auto raise = [](double& largest, double value) {
    if (!(value <= largest) && !std::isnan(largest)) largest = value;
  };
  raise(summary.largest_residual, point.residual);
  raise(summary.largest_energy_imbalance, point.energy_imbalance);
  raise(summary.largest_dissipation_mismatch, point.dissipation_mismatch);
  raise(summary.largest_three_states_share, point.report.three_states_share);
  raise(summary.largest_left_out, point.harmonics_left_out);
  const bool unproved = point.stability == solver::Stability::stable &&
                        point.stability_basis == solver::StabilityBasis::hill;
  summary.stable_unproved += unproved ? 1 : 0;
  summary.harmonic_orders.insert(point.orders.begin(), point.orders.end());
  summary.most_harmonics = std::max(summary.most_harmonics, point.orders.size());
}

}  // namespace

CurveSummary summarise(const CurveResult& result) {
  CurveSummary summary;
  summary.richer = result.richer;
  if (result.richer) {
    const auto& change = result.richer->change;
    summary.largest_left_out =
        change ? std::abs(*change) : std::numeric_limits<double>::quiet_NaN();
  }
  summary.name = result.name;
  summary.preload = result.load;
  summary.gap = result.gap;
  summary.complete = result.curve.complete;
  summary.diagnosis = result.curve.diagnosis;
  summary.message = result.curve.message;
  summary.points = result.curve.points.size();
  summary.iterations = result.curve.iterations;
  summary.contact_evaluations = result.curve.contact_evaluations;
  summary.state_readings = result.curve.state_readings;
  summary.state_cuts = result.curve.state_cuts;
  summary.seconds = result.curve.seconds;
  for (const solver::ResponsePoint& point : result.curve.points) add_point(summary, point);
  if (!result.richer && !is_left_out_known(result.curve, summary.largest_left_out)) {
    summary.largest_left_out = std::numeric_limits<double>::quiet_NaN();
  }
  const auto highest = std::ranges::max_element(summary.peaks, {}, &PeakSummary::amplitude);
  if (highest != summary.peaks.end()) {
    summary.peak = *highest;
  } else if (result.curve.complete && !result.curve.points.empty()) {
    const solver::ResponsePoint& largest =
        *std::ranges::max_element(result.curve.points, {}, &solver::ResponsePoint::amplitude);
    summary.peak = {largest.frequency, largest.amplitude, largest.energy.friction, true};
  }
  for (const NamedMap& map : result.maps) summary.maps.push_back(map.name);
  summary.certificate = result.curve.certificate;
  summary.remedies = result.curve.log;
  summary.detached_branches = result.curve.detached.size();
  summary.search_starts = result.curve.n_starts;
  return summary;
}

Eigen::VectorXd worst_fit_error(const ReducedModel& model) {
  Eigen::VectorXd worst;
  for (const contact::Patch& patch : model.patches) {
    if (patch.fit_error.size() == 0) continue;
    worst = worst.size() == 0 ? patch.fit_error : worst.cwiseMax(patch.fit_error).eval();
  }
  return worst;
}

std::vector<ModeSummary> summarise_modes(const Eigen::VectorXd& frequency,
                                         const Eigen::VectorXd& damping_ratio,
                                         const Eigen::VectorXd& residual,
                                         const Eigen::VectorXd& fit_error,
                                         Eigen::Index n_attachment) {
  const Eigen::Index n = frequency.size();
  std::vector<ModeSummary> modes;
  for (Eigen::Index mode = 0; mode < n; ++mode) {
    modes.push_back({frequency[mode], entry(damping_ratio, mode).value_or(0.0),
                     entry(residual, mode), entry(fit_error, mode), mode >= n - n_attachment});
  }
  return modes;
}

}  // namespace microslip::pipelines
