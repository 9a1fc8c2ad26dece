#include "contact/plane/planar_stick.hpp"

#include <algorithm>

#include "contact/bracketed_root.hpp"

namespace microslip::contact {
namespace {

using Eigen::Vector2d;

/// Guard of a stuck point, |F| − r with F = K (x − s), and its rate.
struct Guard {
  double value = 0.0;
  double rate = 0.0;
};

Guard stick_guard(const PlanarInstant& now, const Vector2d& slider) {
  const Vector2d force = now.force(slider);
  const Vector2d force_rate = now.force_rate(slider);
  const double size = force.norm();
  const double growth = size > stick_slack ? force.dot(force_rate) / size : force_rate.norm();
  return {size - now.radius, growth - now.radius_rate};
}

class RestingSlider {
 public:
  RestingSlider(const PlanarMotion& motion, const Vector2d& slider)
      : motion_(motion), slider_(slider) {}

  [[nodiscard]] double end(const PlanarInterval& interval, const PlanarInstant& from) const {
    const auto& grid = interval.grid;
    const auto after = [](double phase, const PlanarInstant& x) { return phase < x.phase; };
    PlanarInstant low = from;
    for (auto next = std::upper_bound(grid.begin(), grid.end(), from.phase, after);
         next != grid.end(); ++next) {
      const double found = breach_in_cell(low, *next);
      if (found <= next->phase) return found;
      low = *next;
    }
    return interval.end;
  }

 private:
  [[nodiscard]] double force_growth(const PlanarInstant& now) const {
    return now.force(slider_).dot(now.force_rate(slider_));
  }

  /// First phase at which the guard of stick is broken, or beyond the cell. Where the force passes
  /// through a minimum the guard may have an edge: both sides are looked at.
  [[nodiscard]] double breach_in_cell(const PlanarInstant& low, const PlanarInstant& high) const {
    const double growth_low = force_growth(low);
    const double growth_high = force_growth(high);
    if (!(growth_low < 0.0 && growth_high > 0.0)) return breach_between(low, high);
    const auto growth = [this](double phase) { return force_growth(motion_.at(phase)); };
    const double aside = 1e-6 * (high.phase - low.phase);  // the force is no larger in between
    const double smallest =
        bracketed_root(growth, low.phase, high.phase, growth_low, growth_high, 0.01 * aside);
    const PlanarInstant left = motion_.at(std::max(smallest - aside, low.phase));
    const PlanarInstant right = motion_.at(std::min(smallest + aside, high.phase));
    const double found = breach_between(low, left);
    return found <= left.phase ? found : breach_between(right, high);
  }

  /// Whether the cubic through two guards and their rates comes closer to 0 than half of what it
  /// varies by: then a peak between them may pass it.
  static bool may_peak(const Guard& a, const Guard& b, double length) {
    const auto [low, high] = std::minmax(
        {a.value, a.value + a.rate * length / 3.0, b.value - b.rate * length / 3.0, b.value});
    return high > 0.5 * (low - high);
  }

  /// The same where the force has no minimum inside.
  /// @param depth  how often the cell may be halved.
  [[nodiscard]] double breach_between(const PlanarInstant& low, const PlanarInstant& high,
                                      int depth = 5) const {
    const auto guard = [this](const PlanarInstant& now) { return stick_guard(now, slider_); };
    const Guard before = guard(low);
    const Guard after = guard(high);
    const bool peaks = before.rate > 0.0 && after.rate < 0.0;
    if (after.value <= stick_slack && !peaks && depth > 0 &&
        may_peak(before, after, high.phase - low.phase)) {
      const PlanarInstant middle = motion_.at(0.5 * (low.phase + high.phase));
      const double found = breach_between(low, middle, depth - 1);
      return found <= middle.phase ? found : breach_between(middle, high, depth - 1);
    }
    double end = high.phase;
    double value = after.value - stick_slack;
    if (value <= 0.0 && peaks) {
      const auto rate = [&](double phase) { return guard(motion_.at(phase)).rate; };
      constexpr double enough = 1e-9;  // the guard is flat there: its error is the square
      end = bracketed_root(rate, low.phase, end, before.rate, after.rate, enough);
      value = guard(motion_.at(end)).value - stick_slack;
    }
    if (value <= 0.0) return high.phase + 1.0;
    const double start = before.value - stick_slack;
    const auto excess = [&](double phase) {
      const Guard now = guard(motion_.at(phase));
      return Guard{now.value - stick_slack, now.rate};
    };
    return start < 0.0 ? bracketed_newton(excess, low.phase, end, start, value) : low.phase;
  }

  const PlanarMotion& motion_;
  const Vector2d& slider_;
};

}  // namespace

double end_of_stick(const PlanarMotion& motion, const PlanarInterval& interval,
                    const Eigen::Vector2d& slider, const PlanarInstant& from) {
  return RestingSlider(motion, slider).end(interval, from);
}

}  // namespace microslip::contact
