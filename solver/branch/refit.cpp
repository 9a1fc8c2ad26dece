#include "solver/branch/refit.hpp"

#include <utility>

#include "solver/branch/start_point.hpp"

namespace microslip::solver {

RefitReport refit_to(const HarmonicBalance& balance, const std::vector<BranchVector>& points) {
  const auto& force = balance.scene().contact;
  if (!force) return {};
  std::vector<contact::Motion> motions;
  motions.reserve(points.size());
  for (const BranchVector& point : points) {
    motions.push_back({balance.harmonics(point.x), point.parameter});
  }
  const contact::Refit refit = force->refit(motions);
  return {refit.outcome == contact::Refit::Outcome::replaced, false, refit.change};
}

RefitReport refit_step(BranchWalker& walker, const HarmonicBalance& balance,
                       std::vector<BranchVector> points) {
  points.push_back(walker.now().solution.point);
  points.push_back(walker.before().solution.point);
  RefitReport report = refit_to(balance, points);
  if (!report.is_replaced) return report;
  if (!walker.change_unknowns([](const Eigen::VectorXd& x) { return x; })) {
    balance.scene().contact->undo_refit();
    report.is_replaced = false;
    report.is_kept = true;
  }
  return report;
}

RefittedSolution settle_force(const HarmonicBalance& balance, NewtonResult solution,
                              double tolerance) {
  RefittedSolution result;
  result.solution = std::move(solution);
  if (!balance.scene().contact) return result;
  balance.scene().contact->begin_point();
  NewtonOptions newton;
  newton.tolerance = tolerance;
  while (true) {
    const RefitReport report = refit_to(balance, {result.solution.point});
    result.change = report.change;
    if (!report.is_replaced) return result;
    const BranchVector& point = result.solution.point;
    NewtonResult again = solve_at(balance, point.x, point.parameter, newton);
    result.iterations += again.iterations;
    result.evaluations += again.evaluations;
    if (!again.converged) {
      balance.scene().contact->undo_refit();
      result.settled = false;
      return result;
    }
    result.solution = std::move(again);
  }
}

}  // namespace microslip::solver
