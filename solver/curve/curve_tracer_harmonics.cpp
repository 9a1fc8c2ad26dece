// The part of CurveTracer that changes harmonics, and the force where it follows the motion, along the branch.

#include <algorithm>
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
  if (choice_) {
    SettledSolution result = settle_harmonics(*choice_, scene_, balance_->set(), std::move(at),
                                              options_.residual_tolerance);
    curve_.contact_evaluations += result.evaluations;
    curve_.iterations += result.iterations;
    if (!result.settled) curve_.log.push_back({result.solution.point.parameter, "harmonics-kept"});
    left_out_ = result.left_out;
    use(result.set);
    at = std::move(result.solution);
  }
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

bool CurveTracer::change_harmonics(BranchWalker& walker, const HarmonicSet& set) {
  std::unique_ptr<HarmonicBalance> old = std::move(balance_);
  use(set);
  const bool changed = walker.change_unknowns([&](const Eigen::VectorXd& x) {
    return balance_->unknowns(old->harmonics(x));
  });
  if (!changed) {
    balance_ = std::move(old);
    last_x_.resize(0);
  }
  take_stock(walker);
  return changed;
}

bool CurveTracer::enlarge(BranchWalker& walker, const NewtonResult& at) {
  const WalkerPoint& now = walker.now();
  if (!scene_.contact) return false;
  const double scale = now.scaling.residual;
  if (const std::optional<double> missing = screening_->missing(*balance_, at, scale)) {
    left_out_ = *missing;
    return false;
  }
  const HarmonicDecision decision =
      choice_->enlarged(*balance_, at.point, now.tangent, now.scaling, screening_->skips());
  ++curve_.contact_evaluations;
  left_out_ = decision.missing;
  screening_->remember(*balance_, at, decision);
  if (decision.added.empty()) return false;
  if (change_harmonics(walker, decision.set)) return true;
  const HarmonicSet next = balance_->set().united({decision.added.front()});
  if (decision.added.size() > 1 && change_harmonics(walker, next)) return true;
  curve_.log.push_back({now.solution.point.parameter, "harmonics-kept"});
  return false;
}

void CurveTracer::enlarge(BranchWalker& walker) {
  if (!choice_) return;
  while (enlarge(walker, walker.now().solution)) {
  }
}

void CurveTracer::reduce(BranchWalker& walker) {
  if (!choice_) return;
  const WalkerPoint& now = walker.now();
  const HarmonicDecision decision =
      choice_->reduced(*balance_, now.solution, now.tangent, now.scaling, left_out_);
  if (decision.set != balance_->set()) static_cast<void>(change_harmonics(walker, decision.set));
}

ResponseCurve CurveTracer::finished() {
  int highest = 1;
  for (const ResponsePoint& point : curve_.points) {
    highest = std::max(highest, point.q.n_harmonics());
  }
  for (ResponsePoint& point : curve_.points) {
    if (point.q.n_harmonics() == highest) continue;
    Harmonics q(highest, scene_.n_modes());
    q.rows().topRows(point.q.rows().rows()) = point.q.rows();
    point.q = std::move(q);
  }
  mark_unsolved(curve_);
  return std::move(curve_);
}

}  // namespace microslip::solver
