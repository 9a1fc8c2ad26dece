#include "solver/richer_peak.hpp"

#include <vector>

#include "solver/enrichment/enrichment.hpp"
#include "solver/enrichment/level_point.hpp"
#include "solver/peak/high_points.hpp"

namespace microslip::solver {
namespace {

constexpr double farthest = 4.0;  // amplitudes or widths along the branch

/// The highest peak of the curve itself; without one an end of the range. What stopped somewhere has neither.
std::optional<HighPoint> top_of(const std::vector<HighPoint>& high) {
  for (const PeakPlace place : {PeakPlace::peak, PeakPlace::range_end}) {
    for (const HighPoint& point : high) {
      if (point.place == place && !point.detached) return point;
    }
  }
  return std::nullopt;
}

/// A peak that leaves the range is still one.
ContinuationOptions widened(ContinuationOptions range) {
  constexpr double beyond = 0.1;
  const bool forward = range.frequency_begin < range.frequency_end;
  (forward ? range.frequency_begin : range.frequency_end) *= 1.0 - beyond;
  (forward ? range.frequency_end : range.frequency_begin) *= 1.0 + beyond;
  return range;
}

/// From set to set; empty where one of them is not reached.
std::optional<LocalPeak> through(const Scene& scene, const ContinuationOptions& range,
                                 HarmonicSet set, std::optional<LocalPeak> peak,
                                 const std::vector<int>& highest) {
  PeakWork work;
  for (const int next : highest) {
    if (!peak) break;
    const HarmonicBalance coarse(scene, set);
    set = set.united(HarmonicSet(next).orders());
    const HarmonicBalance richer(scene, set);
    peak = level_point(richer, embedded(*peak, coarse, richer), range, work, farthest);
  }
  return peak;
}

}  // namespace

std::optional<RicherPeak> richer_peak(const Scene& scene, const ContinuationOptions& range,
                                      const ResponseCurve& curve, int highest) {
  if (curve.points.empty() || !scene.contact) return std::nullopt;
  const HarmonicBalance coarse(scene, first_harmonics(scene, range));
  const std::optional<HighPoint> highest_point = top_of(high_points(scene, curve, range));
  if (!highest_point) return std::nullopt;
  const HighPoint& top = *highest_point;
  const std::optional<LocalPeak> peak = top.place == PeakPlace::range_end
                                            ? local_end(coarse, top.point, range)
                                            : local_peak(coarse, top.point);
  if (!peak) return std::nullopt;
  RicherPeak result{top.point.frequency, top.point.amplitude, std::nullopt, highest};
  const int given = coarse.set().highest();
  const ContinuationOptions wide = widened(range);
  std::optional<LocalPeak> found = through(scene, wide, coarse.set(), peak, {highest});
  // A peak that is far is nearer by steps.
  if (!found) {
    found = through(scene, wide, coarse.set(), peak, {given + 1, given + 2, given + 4, highest});
  }
  if (!found) return result;
  result.frequency = found->point.parameter;
  result.amplitude = found->amplitude;
  if (found->amplitude > 0.0) {
    result.change = (found->amplitude - top.point.amplitude) / found->amplitude;
  }
  return result;
}

}  // namespace microslip::solver
