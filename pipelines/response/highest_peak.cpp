#include "pipelines/response/highest_peak.hpp"

#include <algorithm>

namespace microslip::pipelines {
const solver::ResponsePoint* highest_peak(const solver::ResponseCurve& curve) {
  const solver::ResponsePoint* best = nullptr;
  for (const bool marked : {true, false}) {
    for (const solver::ResponsePoint& point : curve.points) {
      if (marked && point.mark != solver::PointMark::peak) continue;
      if (best == nullptr || point.amplitude > best->amplitude) best = &point;
    }
    if (best != nullptr) return best;
  }
  return nullptr;
}

const solver::ResponsePoint* peak_above_all(const solver::ResponseCurve& curve) {
  const solver::ResponsePoint* peak = highest_peak(curve);
  if (peak == nullptr || peak->mark != solver::PointMark::peak) return nullptr;
  constexpr double rounding = 1e-9;
  const double most = (1.0 + rounding) * peak->amplitude;
  const bool is_above = std::ranges::all_of(
      curve.points, [&](const solver::ResponsePoint& one) { return one.amplitude <= most; });
  return is_above ? peak : nullptr;
}

const solver::ResponsePoint* nearest_peak(const solver::ResponseCurve& curve, double frequency) {
  const solver::ResponsePoint* nearest = nullptr;
  for (const solver::ResponsePoint& point : curve.points) {
    if (point.mark != solver::PointMark::peak) continue;
    const auto distance = [&](const auto& one) { return std::abs(one.frequency - frequency); };
    if (nearest == nullptr || distance(point) < distance(*nearest)) nearest = &point;
  }
  return nearest;
}

bool is_unsettled(const solver::ResponseCurve& curve) {
  return std::ranges::any_of(curve.log, [](const solver::SolverEvent& event) {
    return event.remedy == solver::Remedy::harmonics_kept;
  });
}

bool is_left_out_known(const solver::ResponseCurve& curve, double left_out) {
  constexpr double most = 0.1;
  return !is_unsettled(curve) || (left_out > 0.0 && left_out < most);
}

}  // namespace microslip::pipelines
