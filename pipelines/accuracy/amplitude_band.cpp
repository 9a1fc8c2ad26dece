#include "pipelines/accuracy/amplitude_band.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "pipelines/response/highest_peak.hpp"

namespace microslip::pipelines {
namespace {

/// Relative, half widths.
struct Box {
  double frequency = 0.0;
  double amplitude = 0.0;
};

Box box_of(const std::vector<ErrorRow>& rows, bool of_harmonics) {
  Box box;
  for (const ErrorRow& row : rows) {
    if ((row.source == "harmonics") != of_harmonics) continue;
    if (row.goal == peak_frequency_goal) box.frequency += std::abs(row.effect);
    if (row.goal == peak_amplitude_goal) box.amplitude += std::abs(row.effect);
  }
  return box;
}

std::vector<Box> boxes_of(const CurveResult& result, const CurveBudget& budget) {
  const std::vector<solver::ResponsePoint>& points = result.curve.points;
  const Box others = box_of(budget.rows, false);
  const Box harmonics = box_of(budget.rows, true);
  std::vector<Box> boxes(points.size(), others);
  const bool are_told = budget.along.size() == points.size();
  const solver::ResponsePoint* highest = highest_peak(result.curve);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Box here = &points[i] == highest || !are_told
                         ? harmonics
                         : Box{budget.along[i].frequency, budget.along[i].amplitude};
    boxes[i].frequency += here.frequency;
    boxes[i].amplitude += here.amplitude;
  }
  return boxes;
}

struct Interval {
  double low = 0.0;
  double high = 0.0;

  void take(double amplitude, double half_width) {
    low = std::min(low, amplitude * (1.0 - half_width));
    high = std::max(high, amplitude * (1.0 + half_width));
  }
};

/// Beyond an end of the range, as far as a box reaches, a curve goes on as it does there: in
/// proportion, so that it stays above zero.
double beyond(const solver::ResponsePoint& end, const solver::ResponsePoint& before,
              double distance) {
  if (!end.slope || !(end.amplitude > 0.0)) return end.amplitude;
  const double way = std::copysign(distance, end.frequency - before.frequency);
  return end.amplitude * std::exp(end.slope->amplitude * way / end.amplitude);
}

/// Boxes of the branch from a point on, one way, as far as they hold its frequency.
void take_along(const std::vector<solver::ResponsePoint>& points, const std::vector<Box>& boxes,
                std::size_t from, std::ptrdiff_t way, Interval& interval) {
  const double place = points[from].frequency;
  const auto n = static_cast<std::ptrdiff_t>(points.size());
  for (auto i = static_cast<std::ptrdiff_t>(from) + way; 0 <= i && i < n; i += way) {
    const auto at = static_cast<std::size_t>(i);
    const auto before = static_cast<std::size_t>(i - way);
    const double reach = std::max(boxes[at].frequency, boxes[before].frequency) * place;
    const double distance = std::abs(points[at].frequency - place);
    if (distance <= reach) {
      interval.take(points[at].amplitude, boxes[at].amplitude);
      continue;
    }
    const double step = distance - std::abs(points[before].frequency - place);
    const double part = step > 0.0 ? std::clamp(1.0 - (distance - reach) / step, 0.0, 1.0) : 0.0;
    interval.take(std::lerp(points[before].amplitude, points[at].amplitude, part),
                  std::lerp(boxes[before].amplitude, boxes[at].amplitude, part));
    return;
  }
  if (n < 2) return;
  const std::size_t end = way > 0 ? points.size() - 1 : 0;
  const std::size_t before = way > 0 ? points.size() - 2 : 1;
  const double left = boxes[end].frequency * place - std::abs(points[end].frequency - place);
  if (left > 0.0) {
    interval.take(beyond(points[end], points[before], left), boxes[end].amplitude);
  }
}

}  // namespace

AmplitudeBand amplitude_band(const CurveResult& result, const CurveBudget& budget) {
  const std::vector<solver::ResponsePoint>& points = result.curve.points;
  const std::vector<Box> boxes = boxes_of(result, budget);
  AmplitudeBand band;
  for (std::size_t i = 0; i < points.size(); ++i) {
    Interval interval{points[i].amplitude, points[i].amplitude};
    interval.take(points[i].amplitude, boxes[i].amplitude);
    take_along(points, boxes, i, 1, interval);
    take_along(points, boxes, i, -1, interval);
    band.low.push_back(std::max(0.0, interval.low));
    band.high.push_back(interval.high);
  }
  return band;
}

}  // namespace microslip::pipelines
