#include "support/planar_reference.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace microslip::test {
namespace {

using Real = long double;
using Pair = std::array<Real, 2>;

constexpr Real pi = std::numbers::pi_v<long double>;

struct Now {
  Pair x{};
  Real gap_load = 0.0L;
  Real limit = 0.0L;
  Pair k{};
};

class March {
 public:
  March(const PlanarCase& c, int n_steps) : case_(c), n_steps_(n_steps) {
    k_ = {c.point.tangential_stiffness, c.second_stiffness};
    find_contacts();
  }

  PlanarReference run() {
    Pair s{};  // virgin
    constexpr int most_periods = 300;
    Real moved_before = 0.0L;
    for (int period = 0; period < most_periods; ++period) {
      const Pair before = s;
      reset();
      pass(s);
      const Real moved = std::hypot(k_[0] * (s[0] - before[0]), k_[1] * (s[1] - before[1]));
      if (opens_ || moved < 1e-13L * static_cast<Real>(planar_scale(case_))) break;
      // What a geometric approach has still ahead.
      if (period + 1 == most_periods) sum_.doubt = moved * moved / (moved_before - moved);
      moved_before = moved;
    }
    return sum_;
  }

 private:
  [[nodiscard]] Now at(Real phase) const {
    const auto& rows = case_.motion.rows();
    Pair x{rows(0, 0), rows(0, 2)};
    Pair rate{};
    Real v = rows(0, 1);
    for (int h = 1; h <= case_.motion.n_harmonics(); ++h) {
      const Real s = std::sin(h * phase);
      const Real c = std::cos(h * phase);
      x[0] += rows(2 * h - 1, 0) * s + rows(2 * h, 0) * c;
      v += rows(2 * h - 1, 1) * s + rows(2 * h, 1) * c;
      x[1] += rows(2 * h - 1, 2) * s + rows(2 * h, 2) * c;
      rate[0] += h * (rows(2 * h - 1, 0) * c - rows(2 * h, 0) * s);
      rate[1] += h * (rows(2 * h - 1, 2) * c - rows(2 * h, 2) * s);
    }
    if (case_.surface) {
      const SurfaceMoment y = case_.surface(v, std::hypot(rate[0], rate[1]));
      return {x, y.gap_load, y.limit, y.stiffness};
    }
    const Real load = case_.point.rest_load + case_.point.normal_stiffness * v;
    return {x, load, case_.point.friction_coefficient * std::max(load, 0.0L), k_};
  }

  /// Ends of the intervals of contact and separation, from a fixed fine grid.
  void find_contacts() {
    constexpr int n = 4096;
    std::vector<Real> change;
    for (int i = 0; i < n; ++i) {
      Real low = 2.0L * pi * i / n;
      Real high = 2.0L * pi * (i + 1) / n;
      const bool closed = at(low).gap_load > 0.0L;
      if ((at(high).gap_load > 0.0L) == closed) continue;
      for (int k = 0; k < 64; ++k) {
        const Real middle = 0.5L * (low + high);
        ((at(middle).gap_load > 0.0L) == closed ? low : high) = middle;
      }
      if (!closed && !opens_) {
        opens_ = true;
        start_ = change.size();
      }
      change.push_back(high);
    }
    if (!opens_) {
      ends_ = {0.0L, 2.0L * pi};
      return;
    }
    for (std::size_t i = 0; i <= change.size(); ++i) {
      const std::size_t at_end = start_ + i;
      ends_.push_back(at_end < change.size() ? change[at_end]
                                             : change[at_end - change.size()] + 2.0L * pi);
    }
  }

  void reset() {
    const auto size = static_cast<std::size_t>(2 * case_.motion.n_harmonics() + 1);
    sum_ = {};
    sum_.first.assign(size, 0.0L);
    sum_.second.assign(size, 0.0L);
  }

  void pass(Pair& s) {
    for (std::size_t i = 0; i + 1 < ends_.size(); ++i) {
      const Real begin = ends_[i];
      const Real length = ends_[i + 1] - begin;
      if (at(begin + 0.5L * length).gap_load <= 0.0L) continue;
      // The same share of the steps at every level, so that errors shrink alike.
      const int cells = std::max(8, static_cast<int>(std::ceil(64.0L * length / (2.0L * pi))));
      const int n = cells * (n_steps_ / 64);
      if (opens_) s = at(begin).x;
      for (int j = 0; j <= n; ++j) {
        const Real weight = (j == 0 || j == n ? 0.5L : 1.0L) * length / n;
        step(begin + length * j / n, weight, s);
      }
    }
  }

  void step(Real phase, Real weight, Pair& s) {
    const Now now = at(phase);
    Pair f{now.k[0] * (now.x[0] - s[0]), now.k[1] * (now.x[1] - s[1])};
    const Pair before = s;
    f = returned(f, now);
    for (std::size_t i = 0; i < 2; ++i) {
      s[i] = now.k[i] > 0.0L ? now.x[i] - f[i] / now.k[i] : now.x[i];
    }
    sum_.dissipated_energy += f[0] * (s[0] - before[0]) + f[1] * (s[1] - before[1]);
    for (int row = 0; row < static_cast<int>(sum_.first.size()); ++row) {
      const int h = (row + 1) / 2;
      const Real kernel = row == 0       ? 0.5L
                          : row % 2 == 1 ? std::sin(h * phase)
                                         : std::cos(h * phase);
      const auto i = static_cast<std::size_t>(row);
      sum_.first[i] += weight * kernel * f[0] / pi;
      sum_.second[i] += weight * kernel * f[1] / pi;
    }
  }

  [[nodiscard]] static Pair returned(const Pair& trial, const Now& now) {
    const Real limit = now.limit;
    if (std::hypot(trial[0], trial[1]) <= limit) return trial;
    if (limit <= 0.0L) return {};
    // |f|² is convex and falls with λ: Newton's method rises to the root from λ = 0.
    const Real k = std::max(now.k[0], now.k[1]);
    Real lambda = 0.0L;
    Pair f = trial;
    for (int i = 0; i < 100; ++i) {
      const Real excess = f[0] * f[0] + f[1] * f[1] - limit * limit;
      if (excess <= 1e-18L * limit * limit) break;
      Real slope = 0.0L;
      for (std::size_t d = 0; d < 2; ++d) {
        slope += 2.0L * f[d] * f[d] * (now.k[d] / k) / (1.0L + lambda * now.k[d] / k);
      }
      lambda += excess / slope;
      for (std::size_t d = 0; d < 2; ++d) f[d] = trial[d] / (1.0L + lambda * now.k[d] / k);
    }
    return f;
  }

  const PlanarCase& case_;
  int n_steps_;
  Pair k_{};
  bool opens_ = false;
  std::size_t start_ = 0;
  std::vector<Real> ends_;
  PlanarReference sum_;
};

}  // namespace

PlanarReference planar_reference(const PlanarCase& c, int n_steps) {
  const PlanarReference a = March(c, n_steps).run();
  const PlanarReference b = March(c, 2 * n_steps).run();
  PlanarReference d = March(c, 4 * n_steps).run();
  Real doubt = std::abs(d.doubt);
  const auto extrapolate = [&doubt](Real coarse, Real middle, Real fine) {
    const Real first = 2.0L * middle - coarse;
    const Real second = 2.0L * fine - middle;
    doubt = std::max(doubt, std::abs(second - first));
    return (4.0L * second - first) / 3.0L;
  };
  for (std::size_t i = 0; i < d.first.size(); ++i) {
    d.first[i] = extrapolate(a.first[i], b.first[i], d.first[i]);
    d.second[i] = extrapolate(a.second[i], b.second[i], d.second[i]);
  }
  d.doubt = doubt;
  d.dissipated_energy = extrapolate(a.dissipated_energy, b.dissipated_energy, d.dissipated_energy);
  return d;
}

double planar_scale(const PlanarCase& c) {
  const auto& rows = c.motion.rows();
  double scale = c.point.friction_coefficient *
                 std::abs(c.point.rest_load + c.point.normal_stiffness * rows(0, 1));
  for (int h = 1; h <= c.motion.n_harmonics(); ++h) {
    scale += c.point.tangential_stiffness * std::hypot(rows(2 * h - 1, 0), rows(2 * h, 0)) +
             c.second_stiffness * std::hypot(rows(2 * h - 1, 2), rows(2 * h, 2)) +
             c.point.friction_coefficient * c.point.normal_stiffness *
                 std::hypot(rows(2 * h - 1, 1), rows(2 * h, 1));
  }
  return scale;
}

}  // namespace microslip::test
