#include "contact/planar_intervals.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "contact/bracketed_root.hpp"

namespace microslip::contact {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;
constexpr int cells_per_harmonic = 24;

/// Phases in [0, 2π) at which f, with derivative `rate`, changes sign.
template <typename Function, typename Rate>
void add_crossings(const Function& f, const Rate& rate, int n_cells, std::vector<double>& found) {
  double low = 0.0;
  double f_low = f(low);
  double rate_low = rate(low);
  for (int i = 1; i <= n_cells; ++i) {
    const double high = two_pi * i / n_cells;
    const double f_high = f(high);
    const double rate_high = rate(high);
    if ((f_low > 0.0) != (f_high > 0.0)) {
      found.push_back(bracketed_root(f, low, high, f_low, f_high));
    } else if ((f_low > 0.0) == (rate_high > 0.0) && (rate_low > 0.0) != (rate_high > 0.0)) {
      const double extremum = bracketed_root(rate, low, high, rate_low, rate_high);
      const double f_extremum = f(extremum);
      if ((f_extremum > 0.0) != (f_low > 0.0)) {
        found.push_back(bracketed_root(f, low, extremum, f_low, f_extremum));
        found.push_back(bracketed_root(f, extremum, high, f_extremum, f_high));
      }
    }
    low = high;
    f_low = f_high;
    rate_low = rate_high;
  }
}

/// Where the tangential speed is smallest: there a rate-dependent coefficient has a kink or nearly one.
void add_slowest(const PlanarMotion& motion, int n_cells, std::vector<double>& found) {
  const auto speed = [&](double phase) { return motion.at(phase).speed; };
  double before = speed(-two_pi / n_cells);
  double now = speed(0.0);
  for (int i = 0; i < n_cells; ++i) {
    const double phase = two_pi * i / n_cells;
    const double cell = two_pi / n_cells;
    const double after = speed(phase + cell);
    if (now <= before && now < after) {
      double low = phase - cell;
      double high = phase + cell;
      constexpr double golden = 0.38196601125010515;
      for (int k = 0; k < 70; ++k) {  // 0.618⁷⁰ = 2e-15
        const double left = low + golden * (high - low);
        const double right = high - golden * (high - low);
        (speed(left) < speed(right) ? high : low) = speed(left) < speed(right) ? right : left;
      }
      found.push_back(0.5 * (low + high) < 0.0 ? 0.5 * (low + high) + two_pi : 0.5 * (low + high));
    }
    before = now;
    now = after;
  }
}

std::vector<double> breakpoints(const PlanarMotion& motion) {
  std::vector<double> found;
  const int n_cells = cells_per_harmonic * motion.n_harmonics();
  const auto rate = [&](double phase) { return motion.approach_rate(phase); };
  std::vector<double> cuts = motion.law().kinks();
  const double vanishing = motion.law().vanishing_approach();
  if (!std::isnan(vanishing)) cuts.push_back(vanishing);
  for (const double kink : cuts) {
    add_crossings([&](double phase) { return motion.approach(phase) - kink; }, rate, n_cells,
                  found);
  }
  if (motion.law().is_rate_dependent()) add_slowest(motion, n_cells, found);
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

bool is_in_contact(const PlanarMotion& motion, double begin, double end) {
  const double middle = 0.5 * (begin + end);
  if (motion.approach(middle) <= motion.law().vanishing_approach()) return false;  // not if NaN
  const SurfaceState surface = motion.at(middle).surface;
  return surface.load > 0.0 && surface.stiffness_ratio > 0.0;
}

/// Intervals between neighbouring points, the last one across 2π.
std::vector<PlanarInterval> between(const PlanarMotion& motion, const std::vector<double>& points) {
  std::vector<PlanarInterval> intervals;
  for (std::size_t i = 0; i < points.size(); ++i) {
    PlanarInterval interval;
    interval.begin = points[i];
    interval.end = i + 1 < points.size() ? points[i + 1] : points.front() + two_pi;
    interval.in_contact = is_in_contact(motion, interval.begin, interval.end);
    intervals.push_back(interval);
  }
  return intervals;
}

void set_grid(const PlanarMotion& motion, PlanarInterval& interval) {
  const double length = interval.end - interval.begin;
  const double cells = std::ceil(length * cells_per_harmonic * motion.n_harmonics() / two_pi);
  const int n = std::max(2, static_cast<int>(cells));
  interval.grid.reserve(static_cast<std::size_t>(n) + 1);
  interval.grid.push_back(motion.at(interval.begin, interval.nudge()));
  for (int i = 1; i < n; ++i) {
    interval.grid.push_back(motion.at(interval.begin + length * i / n));
  }
  interval.grid.push_back(motion.at(interval.end, -interval.nudge()));
}

}  // namespace

double PlanarInterval::nudge() const { return std::min(1e-9, 1e-2 * (end - begin)); }

std::vector<PlanarInterval> planar_intervals(const PlanarMotion& motion) {
  std::vector<double> points = breakpoints(motion);
  if (points.empty()) points.push_back(0.0);
  std::vector<PlanarInterval> intervals = between(motion, points);
  const auto is_open = [](const PlanarInterval& x) { return !x.in_contact; };
  const auto last_open = std::find_if(intervals.rbegin(), intervals.rend(), is_open);
  const bool touches = std::any_of(intervals.begin(), intervals.end(),
                                   [](const PlanarInterval& x) { return x.in_contact; });
  if (last_open == intervals.rend()) {
    if (points.front() != 0.0) {
      points.insert(points.begin(), 0.0);
      intervals = between(motion, points);
    }
  } else if (touches) {
    // Contact after the last open interval, or the first interval if the period ends open.
    std::size_t first = static_cast<std::size_t>(intervals.rend() - last_open);
    if (first == intervals.size()) {
      first = static_cast<std::size_t>(
          std::find_if(intervals.begin(), intervals.end(),
                       [](const PlanarInterval& x) { return x.in_contact; }) -
          intervals.begin());
    }
    for (std::size_t i = 0; i < first; ++i) {
      intervals[i].begin += two_pi;
      intervals[i].end += two_pi;
    }
    std::rotate(intervals.begin(), intervals.begin() + static_cast<std::ptrdiff_t>(first),
                intervals.end());
  }
  bool was_open = !intervals.back().in_contact;
  for (PlanarInterval& interval : intervals) {
    interval.touches_down = interval.in_contact && was_open;
    was_open = !interval.in_contact;
    if (interval.in_contact && motion.has_friction()) set_grid(motion, interval);
  }
  return intervals;
}

}  // namespace microslip::contact
