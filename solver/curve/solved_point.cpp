#include "solver/curve/solved_point.hpp"

#include <utility>

#include "solver/curve/certificate.hpp"
#include "solver/branch/refit.hpp"
#include "solver/stability/stability.hpp"

namespace microslip::solver {

ResponsePoint settled_point(const HarmonicBalance& balance, NewtonResult solution,
                            const ContinuationOptions& options, ResponseCurve& curve) {
  RefittedSolution settled = settle_force(balance, std::move(solution), options.residual_tolerance);
  solution = std::move(settled.solution);
  const double frequency = solution.point.parameter;
  curve.iterations += settled.iterations;
  curve.contact_evaluations += settled.evaluations;
  if (!settled.settled) curve.log.push_back({frequency, "quadrature-kept"});
  const auto stability = stability_in_time(
      balance, balance.harmonics(solution.point.x), frequency,
      assess_stability(balance, solution.evaluation.jacobian, frequency),
      PeriodMapEffort::few_points);
  ResponsePoint point = certified_point(balance, solution, frequency, stability);
  point.quadrature_change = settled.change;
  return point;
}

}  // namespace microslip::solver
