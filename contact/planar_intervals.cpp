#include "contact/planar_intervals.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "contact/bracketed_root.hpp"
#include "contact/sign_changes.hpp"

namespace microslip::contact {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;
constexpr int cells_per_harmonic = 24;

/// Phases at which the load has a kink.
void add_kinks(const PlanarMotion& motion, std::vector<double>& found) {
  const auto& rows = motion.harmonics().rows();
  TrigonometricPolynomial distance;
  distance.reset(motion.n_harmonics());
  for (int h = 1; h <= motion.n_harmonics(); ++h) {
    distance.set(h, rows(2 * h - 1, 1), rows(2 * h, 1));
  }
  std::vector<SignChange> changes;
  for (const double kink : motion.law().kinks()) {
    distance.set_mean(rows(0, 1) - kink);
    find_sign_changes(distance, changes);
    for (const SignChange& change : changes) {
      found.push_back(change.phase < two_pi ? change.phase : 0.0);
    }
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
  add_kinks(motion, found);
  if (motion.law().is_rate_dependent()) add_slowest(motion, n_cells, found);
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

bool is_in_contact(const PlanarMotion& motion, double begin, double end) {
  const SurfaceState surface = motion.at(0.5 * (begin + end)).surface;
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

/// Instants between a minimum of the radius and the end of its cell, ever closer to the minimum as long as
/// the radius still falls: the force may turn there on any of these lengths.
void add_approach(const PlanarMotion& motion, double minimum, double end, double least,
                  std::vector<PlanarInstant>& added) {
  for (double aside = 0.5 * (end - minimum); std::abs(aside) > 1e-8; aside *= 0.5) {
    added.push_back(motion.at(minimum + aside));
    if (added.back().radius <= 2.0 * least) break;
  }
}

/// Where the load nearly vanishes the point may slip for less than a cell of the grid.
void refine_minima(const PlanarMotion& motion, std::vector<PlanarInstant>& grid) {
  std::vector<PlanarInstant> added;
  const auto rate = [&](double phase) { return motion.at(phase).radius_rate; };
  for (std::size_t i = 0; i + 1 < grid.size(); ++i) {
    const PlanarInstant& low = grid[i];
    const PlanarInstant& high = grid[i + 1];
    if (!(low.radius_rate < 0.0 && high.radius_rate > 0.0)) continue;
    const PlanarInstant minimum =
        motion.at(bracketed_root(rate, low.phase, high.phase, low.radius_rate, high.radius_rate));
    if (!(minimum.radius < 0.5 * std::max(low.radius, high.radius))) continue;
    added.push_back(minimum);
    add_approach(motion, minimum.phase, low.phase, minimum.radius, added);
    add_approach(motion, minimum.phase, high.phase, minimum.radius, added);
  }
  if (added.empty()) return;
  grid.insert(grid.end(), added.begin(), added.end());
  std::sort(grid.begin(), grid.end(),
            [](const PlanarInstant& a, const PlanarInstant& b) { return a.phase < b.phase; });
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
  refine_minima(motion, interval.grid);
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
