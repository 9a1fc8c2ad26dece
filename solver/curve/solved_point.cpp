#include "solver/curve/solved_point.hpp"

#include <utility>

#include "solver/curve/certificate.hpp"
#include "solver/stability/stability.hpp"

namespace microslip::solver {
namespace {

ResponsePoint judged_point(HarmonicBalance& balance, const NewtonResult& solution,
                           const ContinuationOptions& options) {
  const double frequency = solution.point.parameter;
  StabilityReport slow = slow_flow_stability(balance, solution.evaluation.jacobian, frequency);
  if (!options.judge_stability) {
    slow.stability = Stability::not_assessed;
    return certified_point(balance, solution, frequency, slow);
  }
  const auto stability = judged_stability(balance, balance.harmonics(solution.point.x), frequency,
                                          std::move(slow), PeriodMapEffort::few_points);
  return certified_point(balance, solution, frequency, stability);
}

}  // namespace

SolvedPoint solved_point(HarmonicBalance& balance, const NewtonResult& solution,
                         const ContinuationOptions& options) {
  const auto with_objection = [&](ResponsePoint point) {
    if (!options.require_proof) return SolvedPoint{std::move(point), {}};
    std::string why = objection(point, gates_of(balance, point, options.residual_tolerance));
    return SolvedPoint{std::move(point), std::move(why)};
  };
  SolvedPoint solved = with_objection(judged_point(balance, solution, options));
  if (solved.why.empty()) return solved;
  const NewtonResult closer = solved_closer(balance, solution, Held::frequency);
  solved = with_objection(judged_point(balance, closer, options));
  solved.evaluations = closer.evaluations;
  return solved;
}

}  // namespace microslip::solver
