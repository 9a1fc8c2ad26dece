#include "contact/plane/planar_corner.hpp"

#include <cmath>

#include "contact/bracketed_root.hpp"

namespace microslip::contact {
namespace {

using Eigen::Vector2d;

class Windows {
 public:
  explicit Windows(const PlanarMotion& motion) : motion_(motion) {}

  /// The maximum of the guard near a phase; nothing if there is none within a quarter of the
  /// shortest wave.
  [[nodiscard]] std::optional<CornerSide> side(double near, const Vector2d& slider) const {
    const auto rate = [&](double phase) { return guard_rate(motion_.at(phase), slider); };
    const double reach = 0.5 * std::acos(-1.0) / motion_.n_harmonics();
    double low = near;
    double high = near;
    const double slope = rate(near);
    double slope_low = slope;
    double slope_high = slope;
    for (double step = 1e-3 * reach; slope != 0.0; step *= 3.0) {
      if (step > reach) return std::nullopt;
      if (slope > 0.0) {
        low = high;
        slope_low = slope_high;
        high = near + step;
        slope_high = rate(high);
        if (slope_high <= 0.0) break;
      } else {
        high = low;
        slope_high = slope_low;
        low = near - step;
        slope_low = rate(low);
        if (slope_low >= 0.0) break;
      }
    }
    constexpr double enough = 1e-11;  // the guard is flat there: its error is the square
    const double phase = bracketed_root(rate, low, high, slope_low, slope_high, enough);
    return at(phase, slider);
  }

 private:
  [[nodiscard]] double guard_rate(const PlanarInstant& now, const Vector2d& slider) const {
    const Vector2d force = now.force(slider);
    const double size = force.norm();
    return (size > 0.0 ? force.dot(now.force_rate(slider)) / size : 0.0) - now.radius_rate;
  }

  [[nodiscard]] CornerSide at(double phase, const Vector2d& slider) const {
    const PlanarInstant now = motion_.at(phase);
    CornerSide side;
    side.phase = phase;
    side.force = now.force(slider);
    const double size = side.force.norm();
    side.excess = size - now.radius;
    if (size > 0.0) side.gradient = -now.stiffness.cwiseProduct(side.force) / size;
    return side;
  }

  const PlanarMotion& motion_;
};

double cross(const Vector2d& a, const Vector2d& b) { return a[0] * b[1] - a[1] * b[0]; }

}  // namespace

std::optional<SliderCorner> meeting_corner(const PlanarMotion& motion,
                                           const std::array<double, 2>& phases,
                                           const Vector2d& slider) {
  const Windows windows(motion);
  SliderCorner corner{slider, {}};
  std::array<double, 2> near = phases;
  double turn = 0.0;
  double last = INFINITY;
  // A corner that is all but a point, where Newton's steps only halve, takes 26 of them to half of
  // the digits, which is what rounding of G leaves of such a corner.
  constexpr int most_steps = 60;
  constexpr double rounding = 2e-16;
  for (int i = 0; i < most_steps; ++i) {
    for (std::size_t j = 0; j < 2; ++j) {
      const std::optional<CornerSide> side = windows.side(near[j], corner.slider);
      if (!side.has_value()) return std::nullopt;
      corner.side[j] = *side;
      near[j] = side->phase;
    }
    const CornerSide& a = corner.side[0];
    const CornerSide& b = corner.side[1];
    const double divisor = cross(a.gradient, b.gradient);
    if (divisor == 0.0 || turn * divisor < 0.0) return std::nullopt;
    turn = divisor;
    const Vector2d step(-(a.excess * b.gradient[1] - b.excess * a.gradient[1]) / divisor,
                        -(b.excess * a.gradient[0] - a.excess * b.gradient[0]) / divisor);
    const double size = motion.stiffness().cwiseProduct(step).norm();
    const bool exhausted = std::abs(a.excess) + std::abs(b.excess) <= 4.0 * rounding;
    if (exhausted || size <= rounding || (size < 1e-7 && size >= last)) return corner;
    if (size > 4.0) return std::nullopt;
    last = size;
    corner.slider += step;
  }
  return std::nullopt;
}

}  // namespace microslip::contact
