// The part of CurveTracer that makes rows of the curve: points with their proof, peaks and folds of
// a step, and the end of the range.

#include <algorithm>
#include <chrono>
#include <numbers>
#include <sstream>
#include <utility>

#include "solver/branch/special_points.hpp"
#include "solver/curve/certificate.hpp"
#include "solver/curve/curve_tracer.hpp"

namespace microslip::solver {

std::string CurveTracer::at_hertz(const std::string& text, double frequency) {
  std::ostringstream stream;
  stream.precision(8);
  stream << text << " at " << frequency / (2.0 * std::numbers::pi) << " Hz";
  return stream.str();
}

StabilityReport CurveTracer::judged(const NewtonResult& at, PointMark mark) {
  const auto linear = damped_linear_stability(*balance_);
  StabilityReport slow = linear ? *linear : stability_at(at);
  if (!options_.judge_stability) slow.stability = Stability::not_assessed;
  if (linear || !options_.judge_stability || mark == PointMark::fold) return slow;
  const double frequency = at.point.parameter;
  const Harmonics q = balance_->harmonics(at.point.x);
  const bool is_peak = mark == PointMark::peak;
  return judged_stability(*balance_, q, frequency, std::move(slow),
                          is_peak ? PeriodMapEffort::few_points : PeriodMapEffort::every_point);
}

ResponsePoint CurveTracer::certified(const NewtonResult& at, PointMark mark) {
  ResponsePoint point = certified_point(*balance_, at, at.point.parameter, judged(at, mark));
  point.mark = mark;
  // At a fold a multiplier is 1 and the slope infinite: on which side they fall is rounding.
  if (mark == PointMark::fold) {
    point.stability = Stability::not_assessed;
    point.slope.reset();
  }
  return point;
}

std::string CurveTracer::objection_to(const ResponsePoint& point) {
  if (!options_.require_proof) return {};
  Gates gates = gates_of(*balance_, point, options_.residual_tolerance);
  if (is_linear_) gates.residual = std::max(gates.residual, linear_rounding);
  return objection(point, gates);
}

/// Steps leave residuals next to rounding; what little work is done may be next to that.
bool CurveTracer::gains_from_closer(const NewtonResult& at, const ResponsePoint& point) const {
  constexpr double next_to = 10.0;  // nearer to rounding, solving again gains no digit
  return options_.corrector == ContinuationOptions::Corrector::newton &&
         point.energy_imbalance > customary_imbalance &&
         at.residual > next_to * rounding_of_residual;
}

bool CurveTracer::add(const NewtonResult& at, PointMark mark, Held held) {
  ResponsePoint point = certified(at, mark);
  if (objection_to(point).empty() && !gains_from_closer(at, point)) {
    return add_certified(std::move(point));
  }
  const NewtonResult closer = solved_closer(*balance_, at, held);
  curve_.contact_evaluations += closer.evaluations;
  return add(certified(closer, mark));
}

bool CurveTracer::add(ResponsePoint point) {
  const std::string why = objection_to(point);
  return why.empty() ? add_certified(std::move(point)) : leave_out(point, why);
}

/// Others are gone on with, but not beyond some in succession.
bool CurveTracer::leave_out(const ResponsePoint& point, const std::string& why) {
  constexpr int most = 3;
  curve_.log.push_back({point.frequency, Remedy::row_left_out});
  if (left_out_.why.empty()) left_out_.why = at_hertz(why, point.frequency);
  ++left_out_.rows;
  if (point.mark == PointMark::peak) ++left_out_.peaks;
  if (point.mark == PointMark::fold) ++left_out_.folds;
  if (++left_out_.in_succession < most) return true;
  stop(Diagnosis::uncertified,
       at_hertz("the proofs of solution after solution fail", point.frequency));
  return false;
}

/// A curve that lacks rows is not complete, whatever its end.
void CurveTracer::tell_left_out() {
  if (left_out_.rows == 0) return;
  curve_.complete = false;
  if (curve_.diagnosis == Diagnosis::none) curve_.diagnosis = Diagnosis::uncertified;
  std::ostringstream text;
  text << curve_.message << (curve_.message.empty() ? "" : "; ") << left_out_.rows
       << " solutions left out (" << left_out_.peaks << " peaks, " << left_out_.folds
       << " folds among them), the first for its " << left_out_.why;
  curve_.message = text.str();
}

bool CurveTracer::add_certified(ResponsePoint point) {
  left_out_.in_succession = 0;
  const Clock::time_point now = Clock::now();
  point.contact_evaluations = curve_.contact_evaluations - point_evaluations_;
  point.seconds = std::chrono::duration<double>(now - last_time_).count();
  point_evaluations_ = curve_.contact_evaluations;
  last_time_ = now;
  curve_.points.push_back(std::move(point));
  return !observe_ || observe_(curve_.points.back());
}

void CurveTracer::note_unsolved(double frequency, PointMark mark) {
  curve_.log.push_back(
      {frequency, mark == PointMark::peak ? Remedy::peak_unsolved : Remedy::fold_unsolved});
}

bool CurveTracer::add_specials(BranchWalker& walker, double share_of_segment) {
  const std::vector<SpecialPoint> found = special_points(walker, *balance_, share_of_segment);
  take_stock(walker);
  for (const SpecialPoint& special : found) {
    if (!(special.share < share_of_segment)) continue;
    if (!special.solved) note_unsolved(special.solution.point.parameter, special.mark);
    if (!add(special.solution, special.mark, Held::place_on_the_branch)) return false;
  }
  return true;
}

bool CurveTracer::reach(BranchWalker& walker, double edge) {
  const double before = walker.before().solution.point.parameter;
  const double now = walker.now().solution.point.parameter;
  if (before == edge) return true;  // a branch that was followed from there
  const double share = (edge - before) / (now - before);
  if (!add_specials(walker, share)) {
    stop(Diagnosis::interrupted, at_hertz("stopped", edge));
    return false;
  }
  const NewtonResult last = walker.at_parameter(edge, share);
  take_stock(walker);
  if (!last.converged) {
    stop(Diagnosis::newton_stall, at_hertz("no solution found", edge));
    return false;
  }
  if (!add(last)) {
    stop(Diagnosis::interrupted, at_hertz("stopped", edge));
    return false;
  }
  return true;
}

}  // namespace microslip::solver
