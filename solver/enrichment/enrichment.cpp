#include "solver/enrichment/enrichment.hpp"

#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "contact/dense.hpp"
#include "solver/balance/output_amplitude.hpp"
#include "solver/branch/branch_geometry.hpp"

namespace microslip::solver {
namespace {

constexpr double most_states = 0.1;   // of (area × period): theory section 24
constexpr double longest_step = 0.3;  // of the amplitude or the width: beyond, another second order
// Along the branch, in scaled variables: curvature is of order one, and rounding of the forces some
// 1e-12.
constexpr double difference_step = 1e-3;

/// [∂R/∂x σ_x/ρ, ∂R/∂ω σ_ω/ρ], n × (n+1)
Eigen::MatrixXd scaled_rows(const BalanceEvaluation& at, const Scaling& scaling) {
  const Eigen::Index n = at.residual.size();
  Eigen::MatrixXd rows(n, n + 1);
  rows.leftCols(n) = at.jacobian * (scaling.x / scaling.residual);
  rows.col(n) = at.parameter_derivative * (scaling.parameter / scaling.residual);
  return rows;
}

/// A with its derivative by the scaled unknowns and the frequency, n + 1.
struct Goal {
  double amplitude = 0.0;
  Eigen::VectorXd gradient;
};

Goal goal_at(const HarmonicBalance& balance, const Eigen::VectorXd& x, double scale) {
  const OutputAmplitude output = output_amplitude(balance.harmonics(x), balance.scene().output);
  Goal goal{output.half_peak_to_peak, Eigen::VectorXd::Zero(x.size() + 1)};
  goal.gradient.head(x.size()) = scale * balance.unknowns(output.gradient);
  return goal;
}

/// The richer equations at the embedded peak, bordered by the coarse tangent, all scaled.
class Bordered {
 public:
  Bordered(const HarmonicBalance& richer, const LocalPeak& peak)
      : richer_(richer),
        peak_(peak),
        n_(peak.point.x.size()),
        goal_(goal_at(richer, peak.point.x, peak.scaling.x)) {
    const BalanceEvaluation at = richer.evaluate(peak.point.x, peak.point.parameter);
    residual_ = at.residual / peak.scaling.residual;
    Eigen::MatrixXd matrix(n_ + 1, n_ + 1);
    matrix.topRows(n_) = scaled_rows(at, peak.scaling);
    const BranchVector border = border_of(peak);
    matrix.row(n_) << border.x.transpose(), border.parameter;
    factors_.emplace(matrix);
    adjoint_ = factors_->solve_transposed(goal_.gradient);
  }

  [[nodiscard]] const Goal& goal() const { return goal_; }
  [[nodiscard]] const Eigen::VectorXd& residual() const { return residual_; }
  /// (μ, ν); ν is the slope g of the amplitude along the richer branch.
  [[nodiscard]] const Eigen::VectorXd& adjoint() const { return adjoint_; }
  [[nodiscard]] bool is_finite() const { return adjoint_.allFinite() && residual_.allFinite(); }

  /// −[R̃; 0] solved for.
  [[nodiscard]] Eigen::VectorXd step() const {
    Eigen::VectorXd right(n_ + 1);
    right << -residual_, 0.0;
    return factors_->solve(right);
  }

  [[nodiscard]] Eigen::VectorXd tangent() const {
    return factors_->solve(Eigen::VectorXd::Unit(n_ + 1, n_));
  }

  [[nodiscard]] Eigen::VectorXd solve_transposed(const Eigen::VectorXd& right) const {
    return factors_->solve_transposed(right);
  }

  /// g_z by central differences along the branch.
  [[nodiscard]] Eigen::VectorXd slope_gradient(const Eigen::VectorXd& tangent) const {
    const auto side = [&](double ahead) {
      const BranchVector direction{tangent.head(n_), tangent[n_]};
      const BranchVector at = moved(peak_.point, direction, ahead, peak_.scaling);
      const BalanceEvaluation there = richer_.evaluate(at.x, at.parameter);
      Eigen::VectorXd value = goal_at(richer_, at.x, peak_.scaling.x).gradient;
      value -= scaled_rows(there, peak_.scaling).transpose() * adjoint_.head(n_);
      return value;
    };
    const double ahead = difference_step / tangent.norm();
    return (side(ahead) - side(-ahead)) / (2.0 * ahead);
  }

 private:
  const HarmonicBalance& richer_;
  const LocalPeak& peak_;
  Eigen::Index n_;
  Goal goal_;
  Eigen::VectorXd residual_;
  std::optional<contact::LuFactors> factors_;
  Eigen::VectorXd adjoint_;
};

/// δω = −η · R̃ + rest, in scaled variables. Empty: A has no curvature that a peak has.
struct FrequencyAdjoint {
  Eigen::VectorXd eta;
  double rest = 0.0;
};

std::optional<FrequencyAdjoint> frequency_adjoint(const Bordered& equations) {
  const Eigen::VectorXd tangent = equations.tangent();
  const Eigen::Index n = tangent.size() - 1;
  const Eigen::VectorXd slope = equations.slope_gradient(tangent);
  const double curvature = slope.dot(tangent);
  if (!(curvature < 0.0) || !slope.allFinite()) return std::nullopt;
  const double along = tangent[n] / curvature;
  FrequencyAdjoint result;
  result.eta = equations.solve_transposed(Eigen::VectorXd::Unit(n + 1, n) - along * slope);
  result.rest = -equations.adjoint()[n] * along;
  return result;
}

std::vector<RicherShare> shares_of(const HarmonicBalance& richer, const Bordered& equations,
                                   const FrequencyAdjoint* frequency, const LocalPeak& peak) {
  const Eigen::Index n = richer.scene().n_modes();
  const double omega = peak.scaling.parameter / peak.point.parameter;
  std::vector<RicherShare> shares;
  const auto add = [&](int order, Eigen::Index first, Eigen::Index count) {
    const auto rows = equations.residual().segment(first, count);
    RicherShare share{order, -equations.adjoint().segment(first, count).dot(rows), 0.0,
                      rows.norm()};
    share.amplitude /= equations.goal().amplitude;
    if (frequency) share.frequency = -omega * frequency->eta.segment(first, count).dot(rows);
    shares.push_back(share);
  };
  add(0, 0, n);
  Eigen::Index first = n;
  for (const int order : richer.set().orders()) {
    add(order, first, 2 * n);
    first += 2 * n;
  }
  return shares;
}

double states_changed(const HarmonicBalance& balance, const BranchVector& a,
                      const BranchVector& b) {
  contact::ContactStates before;
  contact::ContactStates after;
  const auto& contact = balance.scene().contact;
  contact->states(balance.harmonics(a.x), a.parameter, before);
  contact->states(balance.harmonics(b.x), b.parameter, after);
  return contact::state_change(before, after).share;
}

}  // namespace

bool Enrichment::is_estimate() const {
  return length <= longest_step && states_changed <= most_states;
}

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

Enrichment enrich(const HarmonicBalance& richer, const LocalPeak& peak, FrequencyStep ask) {
  const Bordered equations(richer, peak);
  Enrichment result;
  result.evaluations = 1;
  result.point = peak.point;
  result.length = std::numeric_limits<double>::infinity();
  if (!equations.is_finite() || !(equations.goal().amplitude > 0.0)) return result;
  std::optional<FrequencyAdjoint> frequency;
  if (ask == FrequencyStep::estimated && peak.place == PeakPlace::peak) {
    frequency = frequency_adjoint(equations);
    result.evaluations += 2;
  }
  result.has_frequency = frequency.has_value();
  result.shares = shares_of(richer, equations, frequency ? &*frequency : nullptr, peak);
  if (frequency) result.frequency = frequency->rest * peak.scaling.parameter / peak.point.parameter;
  for (const RicherShare& share : result.shares) {
    result.amplitude += share.amplitude;
    result.frequency += share.frequency;
  }
  const Eigen::VectorXd step = equations.step();
  const Eigen::Index n = peak.point.x.size();
  result.length = step.norm();
  result.point = moved(peak.point, {step.head(n), step[n]}, 1.0, peak.scaling);
  if (richer.scene().contact) {
    result.states_changed = states_changed(richer, peak.point, result.point);
  }
  return result;
}

}  // namespace microslip::solver
