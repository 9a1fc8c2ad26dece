#include "solver/richer_peak.hpp"

#include <algorithm>

#include "solver/enrichment/enrichment.hpp"
#include "solver/enrichment/level_point.hpp"
#include "solver/peak/high_points.hpp"

namespace microslip::solver {
namespace {

constexpr double farthest = 4.0;  // amplitudes or widths along the branch

}  // namespace

std::optional<RicherPeak> richer_peak(const Scene& scene, const ContinuationOptions& range,
                                      const ResponseCurve& curve, int highest) {
  if (curve.points.empty() || !scene.contact) return std::nullopt;
  const HarmonicBalance coarse(scene, first_harmonics(scene, range));
  const HarmonicBalance richer(scene, HarmonicSet(highest));
  const std::vector<HighPoint> high = high_points(scene, curve, range);
  const HighPoint& top = high.front();
  const std::optional<LocalPeak> peak = top.place == PeakPlace::range_end
                                            ? local_end(coarse, top.point, range)
                                            : local_peak(coarse, top.point);
  if (!peak) return std::nullopt;
  PeakWork work;
  RicherPeak result{top.point.frequency, top.point.amplitude, std::nullopt, highest};
  const auto found = level_point(richer, embedded(*peak, coarse, richer), range, work, farthest);
  if (!found) return result;
  result.frequency = found->point.parameter;
  result.amplitude = found->amplitude;
  if (found->amplitude > 0.0) {
    result.change = (found->amplitude - top.point.amplitude) / found->amplitude;
  }
  return result;
}

}  // namespace microslip::solver
