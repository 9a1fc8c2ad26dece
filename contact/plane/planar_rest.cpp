#include "contact/plane/planar_rest.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/LU>

#include "contact/bracketed_root.hpp"

namespace microslip::contact {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

/// g near one phase. Sliders are counted in forces here, z = K₀ s.
struct Window {
  PlanarInstant instant;
  double value = 0.0;                     ///< g
  Vector2d gradient = Vector2d::Zero();   ///< by z
  Matrix2d curvature = Matrix2d::Zero();  ///< of the maximum over θ
};

/// The multipliers of a few windows and the step they ask for.
struct Balance {
  Vector2d step = Vector2d::Zero();
  double level = INFINITY;  ///< model of G after the step
  std::array<int, 3> window{-1, -1, -1};
  std::array<double, 3> multiplier{};
};

class RestSearch {
 public:
  RestSearch(const PlanarMotion& motion, const std::vector<PlanarInterval>& intervals)
      : motion_(motion), scale_(motion.stiffness()) {
    for (const PlanarInterval& interval : intervals) {
      for (const PlanarInstant& now : interval.grid) grid_.push_back(&now);
      is_end_.resize(grid_.size(), false);
      is_end_.back() = true;
    }
  }

  RestPlace run(const Vector2d& slider) {
    place_ = scale_.cwiseProduct(slider);
    look();
    RestPlace result;
    double radius = 1.0;
    constexpr int most_steps = 60;
    for (int i = 0; i < most_steps && !rests(); ++i) {
      if (best_ <= -inside) {
        refine();
        continue;
      }
      const Balance balance = balanced(radius);
      lower_ = std::max(lower_, lower_bound(balance));
      const double size = balance.step.norm();
      if (size <= 1e-15 || (size <= small_step && best_ - balance.level <= rest_rounding)) {
        result.converged = best_ > rest_rounding || !fine_.empty();
        if (result.converged) break;
        refine();
        continue;
      }
      if (lower_ > much) break;
      radius = attempt(balance, radius);
    }
    if (best_ <= rest_rounding && fine_.empty()) refine();
    result.slider = place_.cwiseQuotient(scale_);
    result.excess = best_;
    if (best_ <= rest_rounding) {
      result.answer = RestPlace::Answer::rests;
    } else if (result.converged || lower_ > rest_rounding) {
      result.answer = RestPlace::Answer::slips;
    }
    return result;
  }

 private:
  static constexpr double small_step = 1e-8;  ///< along the edges the error of G is its square
  static constexpr double certain = 1e-3;     ///< inside every ellipse, whatever the grid misses
  static constexpr double much = 1e-2;    ///< slip for which the minimum is no good start anyway
  static constexpr double inside = 1e-9;  ///< inside every ellipse the grid sees
  static constexpr std::size_t most_windows = 8;

  static double highest(const std::vector<Window>& windows) {
    double value = -INFINITY;
    for (const Window& window : windows) value = std::max(value, window.value);
    return value;
  }

  [[nodiscard]] bool rests() const {
    return best_ <= -certain || (best_ <= -inside && !fine_.empty());
  }

  void look() {
    windows_ = windows_at(place_);
    best_ = highest(windows_);
  }

  /// A grid of finer cells: two maxima of the coarse one may be in the same or in neighbouring
  /// cells, their difference that of the fourth order of a cell.
  void refine() {
    constexpr int parts = 8;
    const Vector2d slider = slider_of(place_);
    std::vector<bool> is_end;
    for (std::size_t i = 0; i < grid_.size(); ++i) {
      fine_.push_back(*grid_[i]);
      is_end.push_back(is_end_[i]);
      if (is_end_[i] || !may_reach(*grid_[i], *grid_[i + 1], slider)) continue;
      const double length = grid_[i + 1]->phase - grid_[i]->phase;
      for (int k = 1; k < parts; ++k) {
        fine_.push_back(motion_.at(grid_[i]->phase + length * k / parts));
        is_end.push_back(false);
      }
    }
    is_end_ = std::move(is_end);
    grid_.clear();
    for (const PlanarInstant& now : fine_) grid_.push_back(&now);
    look();
  }

  /// Whether the cubic through g and its rates at two instants comes closer to the highest value
  /// than it varies.
  [[nodiscard]] bool may_reach(const PlanarInstant& a, const PlanarInstant& b,
                               const Vector2d& slider) const {
    const double third = (b.phase - a.phase) / 3.0;
    const double at_a = a.force(slider).norm() - a.radius;
    const double at_b = b.force(slider).norm() - b.radius;
    const auto [low, high] = std::minmax(
        {at_a, at_a + third * guard_rate(a, slider), at_b - third * guard_rate(b, slider), at_b});
    return high + (high - low) > best_;
  }

  [[nodiscard]] Vector2d slider_of(const Vector2d& place) const {
    return place.cwiseQuotient(scale_);
  }

  [[nodiscard]] static double guard_rate(const PlanarInstant& now, const Vector2d& slider) {
    const Vector2d force = now.force(slider);
    const double size = force.norm();
    return (size > 0.0 ? force.dot(now.force_rate(slider)) / size : 0.0) - now.radius_rate;
  }

  /// Tries a step; where G does not fall by it what was seen there is kept and the next one is
  /// shorter. A step far shorter than the last is taken as it is: there the method converges,
  /// though the edges of two windows of different curvature may raise G for a while.
  double attempt(const Balance& balance, double radius) {
    const double size = balance.step.norm();
    const Vector2d trial = place_ + balance.step;
    std::vector<Window> seen = windows_at(trial);
    const double value = highest(seen);
    if (value < best_ || size < 0.1 * last_step_) {
      remember(balance);
      place_ = trial;
      best_ = value;
      last_step_ = size;
      for (Window& window : windows_) add_tangent(window.instant, seen);
      windows_ = std::move(seen);
      return std::min(4.0 * std::max(size, 1e-3), 1.0);
    }
    std::vector<Window> windows = std::move(windows_);
    windows_ = std::move(seen);
    for (Window& window : windows_) window = window_of(window.instant, place_);
    for (const Window& window : windows) add_window(window, windows_);
    return 0.5 * std::min(radius, size);
  }

  /// What g is near a phase at the place of the search, unless a window is there already.
  void add_tangent(const PlanarInstant& now, std::vector<Window>& windows) const {
    if (!is_new(now.phase, windows)) return;
    add_window(window_of(now, place_), windows);
  }

  static void add_window(const Window& window, std::vector<Window>& windows) {
    if (!is_new(window.instant.phase, windows) || windows.size() >= most_windows) return;
    windows.push_back(window);
  }

  static bool is_new(double phase, const std::vector<Window>& windows) {
    constexpr double same = 1e-3;
    return std::none_of(windows.begin(), windows.end(), [&](const Window& window) {
      return std::abs(window.instant.phase - phase) < same;
    });
  }

  /// Curvature of the Lagrange function, from the windows that balanced last.
  void remember(const Balance& balance) {
    curvature_.setZero();
    for (std::size_t i = 0; i < 3; ++i) {
      if (balance.window[i] < 0) continue;
      curvature_ +=
          balance.multiplier[i] * windows_[static_cast<std::size_t>(balance.window[i])].curvature;
    }
  }

  [[nodiscard]] double lower_bound(const Balance& balance) const {
    Vector2d gradient = Vector2d::Zero();
    double value = 0.0;
    double reach = INFINITY;
    for (std::size_t i = 0; i < 3; ++i) {
      if (balance.window[i] < 0) continue;
      const Window& window = windows_[static_cast<std::size_t>(balance.window[i])];
      value += balance.multiplier[i] * window.value;
      gradient += balance.multiplier[i] * window.gradient;
      // A slider that rests is no farther than across the ellipse of any one window.
      const double narrow =
          std::min(1.0, window.instant.stiffness.cwiseQuotient(scale_).minCoeff());
      reach = std::min(reach, (window.value + 2.0 * window.instant.radius) / narrow);
    }
    return value - gradient.norm() * reach;
  }

  /// The minimum of the model max (g + ∇g·d) + d·B d/2 over the windows: of all balances of one to
  /// three windows the one that no other window exceeds.
  [[nodiscard]] Balance balanced(double radius) const {
    // Windows bend along their edges alone. Across, where two of them settle the step by
    // themselves, any curvature of order one keeps B regular and does not slow the search down.
    const Vector2d& across = windows_.front().gradient;
    Matrix2d B = curvature_ + across * across.transpose();
    B.diagonal().array() += 1e-8;
    const Matrix2d C = B.inverse();
    Balance best;
    double least_violation = INFINITY;
    const int n = static_cast<int>(windows_.size());
    const auto consider = [&](const Balance& candidate) {
      double violation = 0.0;
      for (const Window& window : windows_) {
        violation = std::max(violation,
                             window.value + window.gradient.dot(candidate.step) - candidate.level);
      }
      if (violation < least_violation) {
        least_violation = violation;
        best = candidate;
      }
    };
    for (int i = 0; i < n; ++i) {
      consider(single(C, i));
      for (int j = 0; j < i; ++j) {
        pair(C, i, j, consider);
        for (int k = 0; k < j; ++k) triple(B, i, j, k, consider);
      }
    }
    const double size = best.step.norm();
    if (size > radius) {
      best.step *= radius / size;
      best.level = -INFINITY;
    }
    return best;
  }

  [[nodiscard]] Balance single(const Matrix2d& C, int i) const {
    const Window& a = windows_[static_cast<std::size_t>(i)];
    Balance result;
    result.step = -C * a.gradient;
    result.level = a.value + a.gradient.dot(result.step);
    result.window[0] = i;
    result.multiplier[0] = 1.0;
    return result;
  }

  template <typename Consider>
  void pair(const Matrix2d& C, int i, int j, const Consider& consider) const {
    const Window& a = windows_[static_cast<std::size_t>(i)];
    const Window& b = windows_[static_cast<std::size_t>(j)];
    const Vector2d apart = a.gradient - b.gradient;
    const Vector2d Ca = C * apart;
    const double divisor = apart.dot(Ca);
    if (!(divisor > 0.0)) return;
    const double share = (a.value - b.value - b.gradient.dot(Ca)) / divisor;
    if (share < 0.0 || share > 1.0) return;
    Balance result;
    result.step = -C * (share * a.gradient + (1.0 - share) * b.gradient);
    result.level =
        std::max(a.value + a.gradient.dot(result.step), b.value + b.gradient.dot(result.step));
    result.window = {i, j, -1};
    result.multiplier = {share, 1.0 - share, 0.0};
    consider(result);
  }

  template <typename Consider>
  void triple(const Matrix2d& B, int i, int j, int k, const Consider& consider) const {
    const Window& a = windows_[static_cast<std::size_t>(i)];
    const Window& b = windows_[static_cast<std::size_t>(j)];
    const Window& c = windows_[static_cast<std::size_t>(k)];
    Matrix2d A;
    A.row(0) = (a.gradient - c.gradient).transpose();
    A.row(1) = (b.gradient - c.gradient).transpose();
    const double divisor = A.determinant();
    if (std::abs(divisor) < 1e-12) return;
    Balance result;
    const Matrix2d inverse = A.inverse();
    result.step = inverse * Vector2d(c.value - a.value, c.value - b.value);
    const Vector2d share = inverse.transpose() * (-B * result.step - c.gradient);
    result.multiplier = {share[0], share[1], 1.0 - share.sum()};
    if (*std::min_element(result.multiplier.begin(), result.multiplier.end()) < 0.0) return;
    result.level = c.value + c.gradient.dot(result.step);
    result.window = {i, j, k};
    consider(result);
  }

  /// The maxima of g over the period, the highest few.
  std::vector<Window> windows_at(const Vector2d& place) {
    const Vector2d slider = slider_of(place);
    guard_.resize(grid_.size());
    for (std::size_t i = 0; i < grid_.size(); ++i) {
      guard_[i] = grid_[i]->force(slider).norm() - grid_[i]->radius;
    }
    std::vector<Window> found;
    const std::size_t n = grid_.size();
    const double top = *std::max_element(guard_.begin(), guard_.end());
    constexpr double far_below = 0.5;
    for (std::size_t i = 1; i < n; ++i) {
      // The last instant of an interval stands for the first of the next as well, at the same
      // phase.
      if (guard_[i] < top - far_below || is_end_[i - 1]) continue;
      const std::size_t next = i + (is_end_[i] ? 2 : 1);
      const double after = guard_[next < n ? next : next - n];
      if (guard_[i] < guard_[i - 1] || guard_[i] <= after) continue;
      found.push_back(window_of(peak_near(i, slider), place));
    }
    if (found.empty()) {  // the same at all phases
      const auto highest = std::max_element(guard_.begin(), guard_.end());
      const auto i = static_cast<std::size_t>(highest - guard_.begin());
      found.push_back(window_of(*grid_[i], place));
    }
    const auto higher = [](const Window& a, const Window& b) { return a.value > b.value; };
    std::sort(found.begin(), found.end(), higher);
    if (found.size() > most_windows / 2) found.resize(most_windows / 2);
    return found;
  }

  /// The instant at which g is highest next to one of the grid,
  /// the first of two where intervals meet.
  [[nodiscard]] PlanarInstant peak_near(std::size_t i, const Vector2d& slider) const {
    const std::size_t next = i + 1 < grid_.size() ? i + 1 : 0;
    const std::size_t right = is_end_[i] ? next : i;
    if (guard_rate(*grid_[right], slider) > 0.0) return peak_between(right, right + 1, slider);
    return peak_between(i - 1, i, slider);
  }

  [[nodiscard]] PlanarInstant peak_between(std::size_t i, std::size_t j,
                                           const Vector2d& slider) const {
    const PlanarInstant& low = *grid_[i];
    const PlanarInstant& high = *grid_[j];
    const double rate_low = guard_rate(low, slider);
    const double rate_high = guard_rate(high, slider);
    if (!(rate_low > 0.0 && rate_high < 0.0)) return guard_[i] > guard_[j] ? low : high;
    const auto rate = [&](double phase) { return guard_rate(motion_.at(phase), slider); };
    constexpr double enough = 1e-9;  // g is flat there: its error is the square
    return motion_.at(bracketed_root(rate, low.phase, high.phase, rate_low, rate_high, enough));
  }

  [[nodiscard]] Window window_of(const PlanarInstant& now, const Vector2d& place) const {
    Window window;
    window.instant = now;
    const Vector2d slider = slider_of(place);
    const Vector2d force = now.force(slider);
    const double size = force.norm();
    window.value = size - now.radius;
    if (!(size > 0.0)) return window;
    const Vector2d D = now.stiffness.cwiseQuotient(scale_);
    const Vector2d e = force / size;
    const Vector2d across(-e[1], e[0]);
    window.gradient = -D.cwiseProduct(e);
    const Vector2d bent = D.cwiseProduct(across);
    window.curvature = bent * bent.transpose() / size;
    const double turn = across.dot(now.force_rate(slider)) / size;
    const Vector2d mixed =
        -(now.stiffness_rate.cwiseQuotient(scale_).cwiseProduct(e) + turn * bent);
    constexpr double aside = 1e-4;
    const double slope = (guard_rate(motion_.at(now.phase + aside), slider) -
                          guard_rate(motion_.at(now.phase - aside), slider)) /
                         (2.0 * aside);
    // Steeper than this the curvature is that of a kink or of many phases alike.
    constexpr double flattest = 1e-3;
    if (slope < -flattest) window.curvature += mixed * mixed.transpose() / -slope;
    return window;
  }

  const PlanarMotion& motion_;
  Vector2d scale_;
  std::vector<const PlanarInstant*> grid_;
  std::vector<PlanarInstant> fine_;
  std::vector<bool> is_end_;
  std::vector<double> guard_;
  std::vector<Window> windows_;
  Vector2d place_ = Vector2d::Zero();
  Matrix2d curvature_ = Matrix2d::Identity();
  double best_ = INFINITY;
  double last_step_ = INFINITY;
  double lower_ = -INFINITY;
};

}  // namespace

RestPlace best_rest(const PlanarMotion& motion, const std::vector<PlanarInterval>& intervals,
                    const Eigen::Vector2d& slider) {
  return RestSearch(motion, intervals).run(slider);
}

}  // namespace microslip::contact
