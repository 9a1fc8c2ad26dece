#include "solver/curve/solved_point.hpp"

#include <utility>

#include "solver/curve/certificate.hpp"
#include "solver/harmonics/harmonic_choice.hpp"
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

ResponsePoint point_with_harmonics(const Scene& scene, HarmonicSet set, NewtonResult solution,
                                   const ContinuationOptions& options, ResponseCurve& curve) {
  double left_out = 0.0;
  if (options.harmonic_tolerance > 0.0) {
    const HarmonicChoice choice(scene, options.harmonic_tolerance, options.n_harmonics);
    SettledSolution settled = settle_harmonics(choice, scene, std::move(set), std::move(solution),
                                               options.residual_tolerance);
    curve.iterations += settled.iterations;
    curve.contact_evaluations += settled.evaluations;
    const double frequency = settled.solution.point.parameter;
    if (!settled.settled) curve.log.push_back({frequency, "harmonics-kept"});
    set = std::move(settled.set);
    solution = std::move(settled.solution);
    left_out = settled.left_out;
  }
  const HarmonicBalance balance(scene, std::move(set));
  ResponsePoint point = settled_point(balance, std::move(solution), options, curve);
  point.harmonics_left_out = left_out;
  return point;
}

}  // namespace microslip::solver
