#include "contact/plane/planar_intervals.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

#include "contact/bracketed_root.hpp"
#include "contact/numerics/sign_changes.hpp"
#include "contact/phase.hpp"

namespace microslip::contact {
namespace {

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

/// d|x'|²/dθ of one signal x, added to Z_m of Σ Z_m z^m, m = 1 … 2H, z = e^{iθ}.
void add_speed_rate(const Eigen::VectorXd& signal, std::vector<std::complex<double>>& sum) {
  const auto H = static_cast<int>(signal.size() / 2);
  const auto rate = [&](int h) -> std::complex<double> {  // of x' = Σ c_h z^h
    const int k = std::abs(h);
    if (k == 0) return 0.0;
    const std::complex<double> positive =
        0.5 * k * std::complex<double>(signal[2 * k - 1], signal[2 * k]);
    return h > 0 ? positive : std::conj(positive);
  };
  for (int m = 1; m <= 2 * H; ++m) {
    std::complex<double> square = 0.0;
    for (int h = m - H; h <= H; ++h) square += rate(h) * rate(m - h);
    sum[static_cast<std::size_t>(m)] += std::complex<double>(0.0, m) * square;
  }
}

/// Where the tangential speed is smallest: there a rate-dependent coefficient has a kink or nearly
/// one. These are the sign changes of a trigonometric polynomial as well: none is missed.
void add_slowest(const PlanarMotion& motion, std::vector<double>& found) {
  const int degree = 2 * motion.n_harmonics();
  const auto& rows = motion.harmonics().rows();
  const double largest = std::max(rows.col(0).tail(degree).cwiseAbs().maxCoeff(),
                                  rows.col(2).tail(degree).cwiseAbs().maxCoeff());
  if (!(largest > 0.0)) return;
  std::vector<std::complex<double>> sum(static_cast<std::size_t>(degree) + 1);
  add_speed_rate(rows.col(0) / largest, sum);
  add_speed_rate(rows.col(2) / largest, sum);
  TrigonometricPolynomial rate;
  rate.reset(degree);
  for (int m = 1; m <= degree; ++m) {
    const std::complex<double> c = sum[static_cast<std::size_t>(m)];
    rate.set(m, -2.0 * c.imag(), 2.0 * c.real());
  }
  std::vector<SignChange> changes;
  find_sign_changes(rate, changes);
  for (const SignChange& change : changes) {
    if (change.rising) found.push_back(change.phase < two_pi ? change.phase : 0.0);
  }
}

std::vector<double> breakpoints(const PlanarMotion& motion) {
  std::vector<double> found;
  add_kinks(motion, found);
  if (motion.law().is_rate_dependent()) add_slowest(motion, found);
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

bool is_in_contact(const PlanarMotion& motion, double begin, double end) {
  const auto touches = [&](double share) {
    const SurfaceState surface = motion.at(begin + share * (end - begin)).surface;
    return surface.load > 0.0 && surface.stiffness_ratio > 0.0;
  };
  // Load that touches zero without passing it may do so right in the middle.
  return touches(0.5) || (touches(0.3) && touches(0.8));
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

/// Instants between a minimum of the radius and the end of its cell, ever closer to the minimum as
/// long as the radius still falls: the force may turn there on any of these lengths.
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

/// Instants between an end of an interval and that of its first cell, ever closer to the end as
/// long as the speed still changes: a coefficient that depends on it changes on these lengths.
void add_slow_layer(const PlanarMotion& motion, const PlanarInstant& slowest, double end,
                    std::vector<PlanarInstant>& added) {
  constexpr double narrowest = 1e-9;  // what may slip in less moves the forces by less
  const double mu = slowest.surface.friction_coefficient;
  for (double aside = 0.5 * (end - slowest.phase); std::abs(aside) > narrowest; aside *= 0.5) {
    added.push_back(motion.at(slowest.phase + aside));
    const PlanarInstant& now = added.back();
    if (now.speed <= 1.1 * slowest.speed) break;
    if (std::abs(now.surface.friction_coefficient - mu) <= 1e-6 * mu) break;
  }
}

void refine_slow_ends(const PlanarMotion& motion, std::vector<PlanarInstant>& grid) {
  std::vector<PlanarInstant> added;
  add_slow_layer(motion, grid.front(), grid[1].phase, added);
  std::reverse(added.begin(), added.end());
  grid.insert(grid.begin() + 1, added.begin(), added.end());
  added.clear();
  add_slow_layer(motion, grid.back(), grid[grid.size() - 2].phase, added);
  grid.insert(grid.end() - 1, added.begin(), added.end());
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
  if (motion.law().is_rate_dependent()) refine_slow_ends(motion, interval.grid);
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
