#include "solver/peak/high_points.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "solver/balance/first_harmonics.hpp"

namespace microslip::solver {
namespace {

// Amplitudes of neighbours on one level differ by rounding; a peak missed by less is of no
// interest.
constexpr double rounding = 1e-7;         // relative
constexpr double same_frequency = 1e-12;  // relative: the walker ends on the ends of the range

bool is_at(const ResponsePoint& point, double frequency) {
  return std::abs(point.frequency - frequency) <= same_frequency * frequency;
}

/// Higher than both neighbours and not solved for as a peak.
bool is_passed_peak(const std::vector<ResponsePoint>& points, std::size_t i) {
  if (i == 0 || i + 1 >= points.size() || points[i].mark == PointMark::peak) return false;
  const double level = (1.0 - rounding) * points[i].amplitude;
  return points[i - 1].amplitude < level && points[i + 1].amplitude < level;
}

/// The peak uphill from a point of the curve; the point itself, unsolved, where none is found.
HighPoint climbed(HarmonicBalance& balance, const ResponsePoint& from,
                  const ContinuationOptions& range) {
  HighPoint high{from, PeakPlace::unsolved};
  const std::optional<LocalPeak> start = local_peak(balance, from);
  if (!start) return high;
  PeakWork work;
  const std::optional<LocalPeak> peak = follow_peak(balance, *start, start->point, range, work);
  if (!peak || peak->amplitude < from.amplitude) return high;
  high.point.frequency = peak->point.parameter;
  high.point.q =
      balance.motion(peak->point.x, balance.residual(peak->point.x, peak->point.parameter));
  high.point.amplitude = peak->amplitude;
  high.point.mark = PointMark::peak;
  high.place = PeakPlace::peak;
  high.climbed = true;
  return high;
}

struct Branch {
  const std::vector<ResponsePoint>& points;
  bool detached = false;
  bool closed = false;
};

void add_high_points(HarmonicBalance& balance, const Branch& branch,
                     const ContinuationOptions& range, std::vector<HighPoint>& high) {
  const std::vector<ResponsePoint>& points = branch.points;
  const auto is_edge = [&](const ResponsePoint& point) {
    return is_at(point, range.frequency_begin) || is_at(point, range.frequency_end);
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool outermost = !branch.closed && (i == 0 || i + 1 == points.size());
    if (points[i].mark == PointMark::peak) {
      high.push_back({points[i], PeakPlace::peak, false, branch.detached});
    } else if (outermost) {
      // An incomplete curve stops anywhere: more amplitude may lie beyond.
      const PeakPlace place = is_edge(points[i]) ? PeakPlace::range_end : PeakPlace::unsolved;
      high.push_back({points[i], place, false, branch.detached});
    } else if (is_passed_peak(points, i)) {
      high.push_back(climbed(balance, points[i], range));
      high.back().detached = branch.detached;
    }
  }
}

}  // namespace

std::vector<HighPoint> high_points(const Scene& scene, const ResponseCurve& curve,
                                   const ContinuationOptions& range) {
  HarmonicBalance balance(scene, first_harmonics(scene, range));
  std::vector<HighPoint> high;
  add_high_points(balance, {curve.points}, range, high);
  for (const DetachedBranch& branch : curve.detached) {
    add_high_points(balance, {branch.points, true, branch.closed}, range, high);
  }
  std::stable_sort(high.begin(), high.end(), [](const HighPoint& a, const HighPoint& b) {
    return a.point.amplitude > b.point.amplitude;
  });
  return high;
}

const HighPoint* highest_of_curve(const std::vector<HighPoint>& high) {
  for (const PeakPlace place : {PeakPlace::peak, PeakPlace::range_end}) {
    for (const HighPoint& point : high) {
      if (point.place == place && !point.detached) return &point;
    }
  }
  return nullptr;
}

}  // namespace microslip::solver
