#include "contact/sampled/plane_corner.hpp"

#include <algorithm>
#include <cmath>

#include "contact/lanes/line_kernels.hpp"

namespace microslip::contact::sampled {
namespace {

using Vector = std::array<double, 2>;

double cross(const Vector& a, const Vector& b) { return a[0] * b[1] - a[1] * b[0]; }

class Windows {
 public:
  Windows(const PlaneArrays& arrays, std::size_t place) : a_(arrays), place_(place) {}

  /// |W⁻¹ (x − s)|².
  [[nodiscard]] double square(std::size_t i, const Vector& slider) const {
    const Vector pull = pull_at(i, slider);
    return pull[0] * pull[0] + pull[1] * pull[1];
  }

  /// The instant of the highest |W⁻¹ (x − s)| that is reached uphill from one.
  [[nodiscard]] std::size_t highest_near(std::size_t i, const Vector& slider) const {
    double best = square(i, slider);
    for (const std::size_t step : {std::size_t{1}, a_.n_instants - 1}) {
      const std::size_t begin = i;
      for (std::size_t next = (i + step) % a_.n_instants; next != begin;
           next = (i + step) % a_.n_instants) {
        const double here = square(next, slider);
        if (here <= best) break;
        best = here;
        i = next;
      }
      if (i != begin) break;
    }
    return i;
  }

  [[nodiscard]] CornerWindow window(std::size_t i, const Vector& slider) const {
    CornerWindow window;
    const std::size_t n = a_.n_instants;
    for (std::size_t k = 0; k < 3; ++k) {
      CornerInstant& now = window.instants[k];
      now.instant = (i + n + k - 1) % n;
      const Vector pull = pull_at(now.instant, slider);
      now.length = std::hypot(pull[0], pull[1]);
      if (!(now.length > 0.0)) continue;
      const std::size_t at = now.instant * block_size + place_;
      now.pull = {pull[0] / now.length, pull[1] / now.length};
      now.normal = {now.pull[0] * a_.inverse_p[at], now.pull[1] * a_.inverse_r[at]};
    }
    const double middle = window.instants[1].length;
    const Vector sides = {window.instants[0].length - middle, window.instants[2].length - middle};
    const double bend = sides[0] + sides[1];
    const double x = bend < 0.0 ? std::clamp(0.5 * (sides[0] - sides[1]) / bend, -1.0, 1.0) : 0.0;
    const std::array<double, 3> shares = {0.5 * x * (x - 1.0), 1.0 - x * x, 0.5 * x * (x + 1.0)};
    window.excess = middle - 1.0 + shares[0] * sides[0] + shares[2] * sides[1];
    for (std::size_t k = 0; k < 3; ++k) {
      window.instants[k].share = shares[k];
      for (std::size_t d = 0; d < 2; ++d) {
        window.normal[d] += shares[k] * window.instants[k].normal[d];
      }
    }
    return window;
  }

 private:
  [[nodiscard]] Vector pull_at(std::size_t i, const Vector& slider) const {
    const std::size_t at = i * block_size + place_;
    return {a_.inverse_p[at] * (a_.u[at] - slider[0]), a_.inverse_r[at] * (a_.w[at] - slider[1])};
  }

  const PlaneArrays& a_;
  std::size_t place_;
};

}  // namespace

std::optional<PlaneCorner> meeting_corner(const PlaneArrays& arrays, std::size_t place,
                                          const std::array<std::size_t, 2>& instants,
                                          const std::array<double, 2>& slider) {
  const Windows windows(arrays, place);
  PlaneCorner corner{slider, {}};
  std::array<std::size_t, 2> highest = instants;
  double turn = 0.0;
  double last = INFINITY;
  // A corner that is all but a point, where Newton's steps only halve, takes 26 of them to half of
  // the digits.
  constexpr int most_steps = 60;
  constexpr double rounding = 4e-16;
  constexpr double small_step = 1e-7;  // of the ellipse: from there on the instants are held
  for (int i = 0; i < most_steps; ++i) {
    for (std::size_t j = 0; j < 2; ++j) {
      if (last > small_step) highest[j] = windows.highest_near(highest[j], corner.slider);
      corner.windows[j] = windows.window(highest[j], corner.slider);
    }
    const CornerWindow& a = corner.windows[0];
    const CornerWindow& b = corner.windows[1];
    const double divisor = cross(a.normal, b.normal);
    if (divisor == 0.0 || turn * divisor < 0.0 || highest[0] == highest[1]) return std::nullopt;
    turn = divisor;
    const Vector step = {(a.excess * b.normal[1] - b.excess * a.normal[1]) / divisor,
                         (b.excess * a.normal[0] - a.excess * b.normal[0]) / divisor};
    const double size = std::hypot(step[0], step[1]) * std::hypot(a.normal[0], a.normal[1]);
    const bool exhausted = std::abs(a.excess) + std::abs(b.excess) <= 2.0 * rounding;
    if (exhausted || size <= rounding || (size < small_step && size >= last)) return corner;
    if (size > 4.0) return std::nullopt;
    last = size;
    corner.slider[0] += step[0];
    corner.slider[1] += step[1];
  }
  return std::nullopt;
}

bool rests_throughout(const PlaneArrays& arrays, std::size_t place,
                      const std::array<double, 2>& slider) {
  const Windows windows(arrays, place);
  for (std::size_t i = 0; i < arrays.n_instants; ++i) {
    if (windows.square(i, slider) > slip_edge) return false;
  }
  return true;
}

std::optional<std::array<std::size_t, 2>> two_ends_of_slip(const PlaneArrays& arrays,
                                                           std::size_t place) {
  std::array<std::size_t, 2> ends{};
  std::size_t n_found = 0;
  const auto slips_at = [&](std::size_t i) {
    return instant_state(arrays.state[i * block_size + place]) == InstantState::slip;
  };
  bool before = slips_at(arrays.n_instants - 1);
  for (std::size_t i = 0; i < arrays.n_instants; ++i) {
    const bool now = slips_at(i);
    if (before && !now) {
      if (n_found == 2) return std::nullopt;
      ends[n_found++] = (i + arrays.n_instants - 1) % arrays.n_instants;
    }
    before = now;
  }
  if (n_found < 2) return std::nullopt;
  return ends;
}

}  // namespace microslip::contact::sampled
