#include "pipelines/response/highest_peak.hpp"

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

}  // namespace microslip::pipelines
