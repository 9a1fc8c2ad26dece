#include "solver/curve/solved_point.hpp"

#include "solver/curve/certificate.hpp"
#include "solver/stability/stability.hpp"

namespace microslip::solver {

ResponsePoint solved_point(HarmonicBalance& balance, const NewtonResult& solution,
                           const ContinuationOptions& options) {
  const double frequency = solution.point.parameter;
  if (!options.judge_stability) {
    StabilityReport slow = slow_flow_stability(balance, solution.evaluation.jacobian, frequency);
    slow.stability = Stability::not_assessed;
    return certified_point(balance, solution, frequency, slow);
  }
  const auto stability =
      stability_in_time(balance, balance.harmonics(solution.point.x), frequency,
                        assess_stability(balance, solution.evaluation.jacobian,
                                         balance.harmonics(solution.point.x), frequency),
                        PeriodMapEffort::few_points);
  return certified_point(balance, solution, frequency, stability);
}

}  // namespace microslip::solver
