#include "solver/branch/branch_geometry.hpp"

#include <cmath>

#include "solver/balance/branch_factors.hpp"

namespace microslip::solver {
namespace {

BranchVector combined(const BranchVector& a, double factor, const BranchVector& b) {
  return {a.x + factor * b.x, a.parameter + factor * b.parameter};
}

}  // namespace

double dot(const BranchVector& a, const BranchVector& b) {
  return a.x.dot(b.x) + a.parameter * b.parameter;
}

double length(const BranchVector& a) { return std::sqrt(dot(a, a)); }

BranchVector rescaled(const BranchVector& direction, const Scaling& from, const Scaling& to) {
  BranchVector result{direction.x * (from.x / to.x),
                      direction.parameter * (from.parameter / to.parameter)};
  const double size = length(result);
  result.x /= size;
  result.parameter /= size;
  return result;
}

Tangent tangent_at(const NewtonResult& at, const BranchVector& previous, const Scaling& scaling) {
  if (!at.factors) return branch_tangent(at.evaluation, previous, scaling);
  const Tangent own = at.factors->tangent();
  Tangent tangent{rescaled(own.direction, at.factors->scaling(), scaling), own.orientation};
  if (dot(tangent.direction, previous) < 0.0) {
    tangent.direction = {-tangent.direction.x, -tangent.direction.parameter};
    tangent.orientation = -tangent.orientation;
  }
  return tangent;
}

BranchVector difference(const BranchVector& a, const BranchVector& b, const Scaling& scaling) {
  return {(a.x - b.x) / scaling.x, (a.parameter - b.parameter) / scaling.parameter};
}

BranchVector moved(const BranchVector& from, const BranchVector& direction, double distance,
                   const Scaling& scaling) {
  return {from.x + distance * scaling.x * direction.x,
          from.parameter + distance * scaling.parameter * direction.parameter};
}

Knot::Knot(const WalkerPoint& at, const BranchVector& chord, double size, const Scaling& scaling)
    : point(at.solution.point) {
  const BranchVector tangent = rescaled(at.tangent, at.scaling, scaling);
  const double along = dot(tangent, chord);
  // A branch that runs across the chord, at a kink, has no such derivative: that of the chord.
  constexpr double across = 0.2;
  const BranchVector& way = along > across ? tangent : chord;
  const double factor = along > across ? size / along : size;
  derivative = {factor * scaling.x * way.x, factor * scaling.parameter * way.parameter};
}

BranchVector cubic_between(const Knot& a, const Knot& b, double u, double width) {
  const double v = 1.0 - u;
  const BranchVector line = combined(combined(a.point, -u, a.point), u, b.point);
  // By its distances from the line.
  const BranchVector rise = combined(b.point, -1.0, a.point);
  BranchVector cubic = combined(line, u * v * v * width, a.derivative);
  cubic = combined(cubic, -u * u * v * width, b.derivative);
  return combined(cubic, u * u * v - u * v * v, rise);
}

std::vector<BranchVector> starts_between(const Knot& a, const Knot& b, double u, double width) {
  const BranchVector line = combined(combined(a.point, -u, a.point), u, b.point);
  const BranchVector from_a = combined(a.point, u * width, a.derivative);
  const BranchVector from_b = combined(b.point, -(1.0 - u) * width, b.derivative);
  const BranchVector cubic = cubic_between(a, b, u, width);
  if (u < 0.5) return {cubic, from_a, from_b, line};
  return {cubic, from_b, from_a, line};
}

}  // namespace microslip::solver
