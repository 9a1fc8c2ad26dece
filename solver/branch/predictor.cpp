#include "solver/branch/predictor.hpp"

#include <limits>

namespace microslip::solver {
namespace {

constexpr double most_bend = 0.3;  // of the step: beyond, the last two points do not tell the next

BranchVector sum(const BranchVector& a, double factor, const BranchVector& b) {
  return {a.x + factor * b.x, a.parameter + factor * b.parameter};
}

BranchVector times(double factor, const BranchVector& a) {
  return {factor * a.x, factor * a.parameter};
}

/// What is added to the tangent's point, scaled.
BranchVector bend(const WalkerPoint& before, const WalkerPoint& now, double ahead, int order) {
  const Eigen::Index n = now.solution.point.x.size();
  BranchVector none{Eigen::VectorXd::Zero(n), 0.0};
  const BranchVector back = difference(before.solution.point, now.solution.point, now.scaling);
  const double way = length(back);
  if (order == 1 || way == 0.0) return none;
  const BranchVector old = rescaled(before.tangent, before.scaling, now.scaling);
  const BranchVector E = times(1.0 / way, sum(now.tangent, -1.0, old));
  BranchVector result = times(0.5 * ahead * ahead, E);
  if (order == 3) {
    const BranchVector D = times(1.0 / (way * way), sum(back, way, now.tangent));
    const BranchVector a = sum(times(3.0, D), -1.0, E);
    const BranchVector b = times(1.0 / way, sum(times(2.0, D), -1.0, E));
    result = sum(times(ahead * ahead, a), ahead * ahead * ahead, b);
  }
  return length(result) <= most_bend * ahead ? result : none;
}

BranchVector predicted(const WalkerPoint& before, const WalkerPoint& now, double ahead, int order) {
  const BranchVector straight = moved(now.solution.point, now.tangent, ahead, now.scaling);
  return moved(straight, bend(before, now, ahead, order), 1.0, now.scaling);
}

}  // namespace

BranchVector BranchPredictor::point(const WalkerPoint& before, const WalkerPoint& now,
                                    double ahead) const {
  return predicted(before, now, ahead, order_);
}

void BranchPredictor::learn(const WalkerPoint& before, const WalkerPoint& now,
                            const BranchVector& next) {
  const double ahead = dot(difference(next, now.solution.point, now.scaling), now.tangent);
  double least = std::numeric_limits<double>::infinity();
  for (const int order : {1, 2, 3}) {
    const BranchVector guess = predicted(before, now, ahead, order);
    const double error = length(difference(guess, next, now.scaling));
    if (error < least) {
      least = error;
      order_ = order;
    }
  }
}

}  // namespace microslip::solver
