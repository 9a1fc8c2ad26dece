// The part of CurveTracer that changes the force along the branch, where it follows the motion.

#include <utility>

#include "solver/curve/curve_tracer.hpp"
#include "solver/branch/refit.hpp"
#include "solver/curve/unmarked_points.hpp"

namespace microslip::solver {

void CurveTracer::use(const HarmonicSet& set) {
  balance_ = std::make_unique<HarmonicBalance>(scene_, set);
  last_x_.resize(0);
}

NewtonResult CurveTracer::settled(NewtonResult at) {
  RefittedSolution result = settle_force(*balance_, std::move(at), options_.residual_tolerance);
  curve_.contact_evaluations += result.evaluations;
  curve_.iterations += result.iterations;
  if (!result.settled) curve_.log.push_back({result.solution.point.parameter, "quadrature-kept"});
  change_ = result.change;
  last_x_.resize(0);
  return std::move(result.solution);
}

bool CurveTracer::refit(BranchWalker& walker, const std::vector<SpecialPoint>& between) {
  std::vector<BranchVector> points;
  points.reserve(between.size());
  for (const SpecialPoint& point : between) points.push_back(point.solution.point);
  const RefitReport report = refit_step(walker, *balance_, std::move(points));
  change_ = report.change;
  if (report.is_replaced || report.is_kept) last_x_.resize(0);
  if (report.is_kept) {
    curve_.log.push_back({walker.now().solution.point.parameter, "quadrature-kept"});
  }
  take_stock(walker);
  return report.is_replaced;
}

void CurveTracer::settle_step(BranchWalker& walker) {
  if (!scene_.contact) return;
  scene_.contact->begin_point();
  while (refit(walker, {})) {
  }
}

ResponseCurve CurveTracer::finished() {
  mark_unsolved(curve_);
  return std::move(curve_);
}

}  // namespace microslip::solver
