#include "pipelines/accuracy/points_to_check.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace microslip::pipelines {
namespace {

using Indices = std::vector<std::size_t>;

/// The first where a value is largest. @param of  not empty.
template <typename Value>
std::size_t largest(const Indices& of, const Value& value) {
  return *std::ranges::max_element(of, {}, value);
}

/// How far along the curve, counted in its points: they are dense where the response turns.
double distance(std::size_t point, const Indices& from) {
  double least = std::numeric_limits<double>::infinity();
  for (const std::size_t other : from) {
    const auto way = static_cast<double>(point) - static_cast<double>(other);
    least = std::min(least, std::abs(way));
  }
  return least;
}

}  // namespace

std::vector<std::size_t> points_to_check(const solver::ResponseCurve& curve,
                                         const Eigen::VectorXd& indicator, double threshold) {
  const auto at = [&](std::size_t i) { return indicator[static_cast<Eigen::Index>(i)]; };
  Indices above;
  Indices peaks;
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    const solver::ResponsePoint& point = curve.points[i];
    const bool is_peak = point.mark == solver::PointMark::peak;
    if (is_peak) peaks.push_back(i);
    if (!is_peak && point.slope && at(i) > threshold) above.push_back(i);
  }
  Indices chosen;
  const auto left_out = [&](std::size_t i) { return at(i) * curve.points[i].amplitude; };
  while (!above.empty() && chosen.size() < most_points_to_check) {
    const std::size_t next =
        chosen.empty() ? largest(above, at) : largest(above, [&](std::size_t i) {
          return left_out(i) * std::min(distance(i, chosen), distance(i, peaks));
        });
    chosen.push_back(next);
    std::erase(above, next);
  }
  return chosen;
}

}  // namespace microslip::pipelines
