#include "support/surface_reference.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace microslip::test {
namespace {

using Real = long double;
using contact::Harmonics;

constexpr Real pi = std::numbers::pi_v<Real>;
constexpr Real two_pi = 2.0L * pi;

struct Wave {
  std::vector<Real> sine, cosine;
  Real mean = 0.0L;

  Wave(const Harmonics& motion, Eigen::Index signal) {
    for (int h = 1; h <= motion.n_harmonics(); ++h) {
      sine.push_back(motion.rows()(2 * h - 1, signal));
      cosine.push_back(motion.rows()(2 * h, signal));
    }
    mean = motion.rows()(0, signal);
  }
  [[nodiscard]] std::array<Real, 3> at(Real x) const {  // y, y', y''
    std::array<Real, 3> y{mean, 0.0L, 0.0L};
    const Real s1 = std::sin(x);
    const Real c1 = std::cos(x);
    Real s = s1;
    Real c = c1;
    for (std::size_t i = 0; i < sine.size(); ++i) {
      const Real h = static_cast<Real>(i) + 1.0L;
      const Real value = sine[i] * s + cosine[i] * c;
      y[0] += value;
      y[1] += h * (sine[i] * c - cosine[i] * s);
      y[2] -= h * h * value;
      const Real next = s * c1 + c * s1;
      c = c * c1 - s * s1;
      s = next;
    }
    return y;
  }
};

struct Height {
  Real delta = 0.0L;  // δ
  Real share = 0.0L;  // h*
  Real reach = 0.0L;  // δ/h*
  Real reach_rate = 0.0L;
};

Height height_at(const ReferenceLaw& law, Real u) {
  if (law.heights == ReferenceHeights::none) {
    return u > 0.0L ? Height{u, 1.0L, u, 1.0L} : Height{};
  }
  if (law.heights == ReferenceHeights::cubic) {
    const Real R = law.height;
    const Real x = u / R;
    if (x <= 0.0L) return {};
    if (x >= 1.0L) return {u - R / 2.0L, 1.0L, u - R / 2.0L, 1.0L};
    const Real q = 3.0L - 2.0L * x;
    return {R * (x * x * x - x * x * x * x / 2.0L), x * x * q, R * x * (1.0L - x / 2.0L) / q,
            ((1.0L - x) * q + 2.0L * x * (1.0L - x / 2.0L)) / (q * q)};
  }
  const Real s = law.deviation;
  const Real z = (u - law.mean) / s;
  const Real phi = std::exp(-z * z / 2.0L) / std::sqrt(two_pi);
  const Real Phi = std::erfc(-z / std::sqrt(2.0L)) / 2.0L;
  const Real J = z * Phi + phi;
  return {s * J, Phi, s * J / Phi, 1.0L - J * phi / (Phi * Phi)};
}

struct State {
  Real load = 0.0L, mu = 0.0L, ratio = 1.0L;  // n, μ, g
  Real reach = 0.0L, reach_rate = 0.0L;       // r, r'
};

class Point {
 public:
  Point(const ReferenceLaw& law, const Harmonics& motion, double frequency)
      : law_(law), u_(motion, 0), v_(motion, 1), frequency_(frequency) {
    slider_mean_ = u_.mean;
    u_.mean = 0.0L;
    const Real k_T = law.point.tangential_stiffness;
    gamma_u_ = static_cast<Real>(law.series.p) * k_T;
    gamma_v_ = static_cast<Real>(law.series.q) * static_cast<Real>(law.point.normal_stiffness);
    k_u = k_T / (1.0L + gamma_u_);
    k_v_ = law.point.normal_stiffness;
    const Real n0 = law.point.preload;
    first_touch_ = law.heights == ReferenceHeights::gaussian ? law.mean - 9.0L * law.deviation : 0.0L;
    if (k_v_ > 0.0L) {
      rest_ = n0 > 0.0L ? inverse(n0 / k_v_) + gamma_v_ * n0 / k_v_
                        : n0 / k_v_ * (1.0L + gamma_v_);
    }
  }

  [[nodiscard]] bool touches(Real x) const {
    if (k_v_ == 0.0L) return law_.point.preload > 0.0;
    return v_.at(x)[0] + rest_ > first_touch_;
  }

  [[nodiscard]] State at(Real x, bool turns) const {
    const auto u = u_.at(x);
    const auto v = v_.at(x);
    State y;
    const Real sigma = turns ? 0.0L : static_cast<Real>(frequency_) * std::abs(u[1]);
    Real mu_rate = 0.0L;
    coefficient(sigma, y.mu, mu_rate);
    if (k_v_ == 0.0L) {
      y.load = std::max<Real>(law_.point.preload, 0.0L);
      set_reach(y, y.load, 0.0L, v[1], mu_rate, u, turns);
      return y;
    }
    const Real closure = v[0] + rest_;
    if (closure <= first_touch_) return y.ratio = 0.0L, y;
    const Height h = height_at(law_, approach(closure));
    const Real du = 1.0L / (1.0L + gamma_v_ * h.share);
    y.load = k_v_ * h.delta;
    y.ratio = h.share * (1.0L + gamma_u_) / (1.0L + gamma_u_ * h.share);
    const Real per_ratio = k_v_ * (h.reach + gamma_u_ * h.delta) / (1.0L + gamma_u_);
    const Real per_ratio_rate = k_v_ * (h.reach_rate + gamma_u_ * h.share) / (1.0L + gamma_u_) * du;
    set_reach(y, per_ratio, per_ratio_rate, v[1], mu_rate, u, turns);
    return y;
  }

  /// Approaches of kinks as roots of v − kink; u' and its slow places.
  [[nodiscard]] std::vector<Real> kinks() const {
    if (k_v_ == 0.0L) return {};
    if (law_.heights == ReferenceHeights::none) return {-rest_};
    const Real last = law_.heights == ReferenceHeights::cubic
                          ? static_cast<Real>(law_.height)
                          : law_.mean + 9.0L * static_cast<Real>(law_.deviation);
    return {first_touch_ - rest_, last + gamma_v_ * (last - law_.mean) - rest_};
  }

  [[nodiscard]] const Wave& u() const { return u_; }
  [[nodiscard]] const Wave& v() const { return v_; }
  [[nodiscard]] Real virgin() const { return -slider_mean_; }
  Real k_u = 0.0L;

 private:
  void coefficient(Real sigma, Real& mu, Real& rate) const {
    const Real mu_0 = law_.point.friction_coefficient;
    mu = mu_0;
    rate = 0.0L;
    if (law_.rate == ReferenceRate::exponential) {
      const Real fade = std::exp(-law_.decay * sigma);
      mu = law_.at_speed + (mu_0 - law_.at_speed) * fade;
      rate = -(mu_0 - law_.at_speed) * fade * law_.decay;
    } else if (law_.rate == ReferenceRate::hyperbolic) {
      const Real growth = 1.0L + law_.decay * sigma;
      mu = mu_0 / growth;
      rate = -mu * law_.decay / growth;
    }
  }
  void set_reach(State& y, Real per_ratio, Real per_ratio_rate, Real v_rate, Real mu_rate,
                 const std::array<Real, 3>& u, bool turns) const {
    if (k_u == 0.0L) return;
    y.reach = y.mu * per_ratio / k_u;
    y.reach_rate = y.mu * per_ratio_rate * v_rate / k_u;
    if (turns) return;
    y.reach_rate += mu_rate * frequency_ * (u[1] < 0.0L ? -1.0L : 1.0L) * u[2] * per_ratio / k_u;
  }
  /// δ(u) = f.
  [[nodiscard]] Real inverse(Real f) const {
    Real low = law_.heights == ReferenceHeights::gaussian ? law_.mean - 60.0L * law_.deviation : 0.0L;
    Real high = f + std::abs(static_cast<Real>(law_.mean)) + 10.0L * law_.deviation +
                static_cast<Real>(law_.height);
    for (int i = 0; i < 300; ++i) {
      const Real middle = (low + high) / 2.0L;
      (height_at(law_, middle).delta < f ? low : high) = middle;
    }
    return high;
  }
  /// u + γ δ(u) = closure.
  [[nodiscard]] Real approach(Real closure) const {
    if (gamma_v_ == 0.0L) return closure;
    Real low = std::min<Real>(closure, first_touch_);
    Real high = closure;
    if (gamma_v_ < 0.0L) {
      high = closure;
      while (high + gamma_v_ * height_at(law_, high).delta < closure) {
        high += std::abs(closure) + static_cast<Real>(law_.height) + law_.deviation;
      }
    }
    Real u = (low + high) / 2.0L;
    for (int i = 0; i < 200; ++i) {  // Newton's method within the bracket
      const Height h = height_at(law_, u);
      const Real beyond = u + gamma_v_ * h.delta - closure;
      (beyond < 0.0L ? low : high) = u;
      Real next = u - beyond / (1.0L + gamma_v_ * h.share);
      if (!(next > low && next < high)) next = (low + high) / 2.0L;
      if (next == u || next == low || next == high) break;
      u = next;
    }
    return u;
  }

  const ReferenceLaw& law_;
  Wave u_, v_;
  Real frequency_;
  Real slider_mean_ = 0.0L, gamma_u_ = 0.0L, gamma_v_ = 0.0L, k_v_ = 0.0L;
  Real first_touch_ = 0.0L, rest_ = 0.0L;
};

template <typename F>
Real bisected(const F& positive, Real low, Real high) {
  const bool at_low = positive(low);
  for (int i = 0; i < 80; ++i) {
    const Real middle = (low + high) / 2.0L;
    (positive(middle) == at_low ? low : high) = middle;
  }
  return (low + high) / 2.0L;
}

/// Roots in [begin, end] of f; roots of its derivative are given, so that it is monotone in between.
template <typename F>
std::vector<Real> roots_between(const F& f, const std::vector<Real>& turns) {
  std::vector<Real> found;
  for (std::size_t i = 0; i + 1 < turns.size(); ++i) {
    if ((f(turns[i]) > 0.0L) == (f(turns[i + 1]) > 0.0L)) continue;
    found.push_back(bisected([&](Real x) { return f(x) > 0.0L; }, turns[i], turns[i + 1]));
  }
  return found;
}

/// Roots of derivative `order` of a wave, with 0 and 2π, by way of the roots of the next ones.
std::vector<Real> wave_roots(const Wave& wave, int order, Real level = 0.0L) {
  const int H = static_cast<int>(wave.sine.size());
  std::vector<Real> stops;
  const int n = 256 * H;
  for (int i = 0; i <= n; ++i) stops.push_back(two_pi * i / n);
  for (int k = 2; k >= order; --k) {
    std::vector<Real> found = roots_between(
        [&](Real x) {
          return wave.at(x)[static_cast<std::size_t>(k)] - (k == order ? level : 0.0L);
        },
        stops);
    if (k == order) return found;
    stops.insert(stops.end(), found.begin(), found.end());
    std::sort(stops.begin(), stops.end());
  }
  return {};
}

struct Stop {
  Real phase;
  bool turns;
};

class March {
 public:
  March(const Point& point, const std::vector<Stop>& stops, int n_harmonics)
      : point_(point), stops_(stops), H_(n_harmonics) {
    result_.friction.assign(2 * static_cast<std::size_t>(H_) + 1, 0.0L);
    result_.normal = result_.friction;
    slider_ = point.virgin();
  }

  SurfaceReference run() {
    for (const bool records : {false, true}) {
      records_ = records;
      for (std::size_t i = 0; i + 1 < stops_.size(); ++i) cross(stops_[i], stops_[i + 1]);
    }
    for (auto* part : {&result_.friction, &result_.normal}) {
      for (Real& x : *part) x /= pi;
      part->front() /= 2.0L;
    }
    return result_;
  }

 private:
  [[nodiscard]] Real end(const Stop& stop, Real sign) const {  // 1: lower, −1: upper
    return point_.u().at(stop.phase)[0] - sign * point_.at(stop.phase, stop.turns).reach;
  }
  [[nodiscard]] Real end(Real phase, Real sign) const { return end({phase, false}, sign); }

  void cross(const Stop& from, const Stop& to) {
    if (!point_.touches((from.phase + to.phase) / 2.0L)) {
      slider_ = point_.u().at(to.phase)[0];
      tell('E');
      return;
    }
    if (point_.k_u > 0.0L) {
      for (const Real sign : {1.0L, -1.0L}) {
        const Real target = end(to, sign);
        if (!(sign * (target - slider_) > 0.0L)) continue;
        Real begin = from.phase;
        if (sign * (slider_ - end(from, sign)) > 0.0L) {
          begin = bisected([&](Real x) { return sign * (end(x, sign) - slider_) > 0.0L; },
                           from.phase, to.phase);
          integrate(from.phase, begin, 0.0L);
          if (begin > from.phase) tell('S');
        }
        tell(sign > 0.0L ? 'P' : 'N');
        integrate(begin, to.phase, sign);
        if (records_) result_.slip_distance += std::abs(target - slider_);
        slider_ = target;
        return;
      }
    }
    tell('S');
    integrate(from.phase, to.phase, 0.0L);
  }

  void tell(char state) {
    if (!records_) return;
    if (result_.sequence.empty() || result_.sequence.back() != state) result_.sequence += state;
  }

  void integrate(Real begin, Real stop, Real sign) {
    if (!records_ || !(stop > begin)) return;
    static const auto rule = gauss();
    const Real half = (stop - begin) / 2.0L;
    for (const auto& [node, weight] : rule) {
      const Real x = begin + half * (1.0L + node);
      const Real w = half * weight;
      const State y = point_.at(x, false);
      const auto u = point_.u().at(x);
      Real f = sign * y.mu * y.load;
      if (sign == 0.0L) f = point_.k_u * y.ratio * (u[0] - slider_);
      if (point_.k_u == 0.0L) f = 0.0L;
      result_.largest_load = std::max(result_.largest_load, y.load);
      add(result_.friction, x, w * f);
      add(result_.normal, x, w * y.load);
      if (sign != 0.0L) {
        result_.dissipated_energy += w * std::abs(f) * std::abs(u[1] - sign * y.reach_rate);
      }
    }
  }

  void add(std::vector<Real>& sums, Real x, Real value) const {
    sums[0] += value;
    for (int h = 1; h <= H_; ++h) {
      sums[static_cast<std::size_t>(2 * h - 1)] += value * std::sin(h * x);
      sums[static_cast<std::size_t>(2 * h)] += value * std::cos(h * x);
    }
  }

  static std::vector<std::array<Real, 2>> gauss() {
    constexpr int n = 20;
    std::vector<std::array<Real, 2>> rule;
    for (int i = 0; i < n; ++i) {
      Real x = std::cos(pi * (i + 0.75L) / (n + 0.5L));
      Real slope = 0.0L;
      for (int k = 0; k < 100; ++k) {
        Real p = 1.0L;
        Real before = 0.0L;
        for (int j = 0; j < n; ++j) {
          const Real next = ((2.0L * j + 1.0L) * x * p - j * before) / (j + 1.0L);
          before = p;
          p = next;
        }
        slope = n * (x * p - before) / (x * x - 1.0L);
        x -= p / slope;
      }
      rule.push_back({x, 2.0L / ((1.0L - x * x) * slope * slope)});
    }
    return rule;
  }

  const Point& point_;
  const std::vector<Stop>& stops_;
  int H_;
  bool records_ = false;
  Real slider_ = 0.0L;
  SurfaceReference result_;
};

/// Extrema of both ends of the band between two stops.
void add_extrema(const Point& point, Real begin, Real end, std::vector<Stop>& stops) {
  if (!point.touches((begin + end) / 2.0L)) return;
  constexpr int n = 8;
  std::array<std::array<Real, 2>, n + 1> rates{};
  const auto rate = [&](Real x, std::size_t side) {
    const Real u = point.u().at(x)[1];
    const Real r = point.at(x, false).reach_rate;
    return side == 0 ? u - r : u + r;
  };
  const auto place = [&](int i) {  // inside: rates jump at the ends
    return begin + (end - begin) * (i + 1e-6L * (i == 0) - 1e-6L * (i == n)) / n;
  };
  for (int i = 0; i <= n; ++i) {
    const Real u = point.u().at(place(i))[1];
    const Real r = point.at(place(i), false).reach_rate;
    rates[static_cast<std::size_t>(i)] = {u - r, u + r};
  }
  for (std::size_t side = 0; side < 2; ++side) {
    const auto add_between = [&](Real a, Real b) {
      const auto positive = [&](Real x) { return rate(x, side) > 0.0L; };
      if (positive(a) != positive(b)) stops.push_back({bisected(positive, a, b), false});
    };
    // A pair between two samples of one sign: about the smallest |rate|.
    const auto add_pair = [&](Real low, Real high, Real sign) {
      const Real begin_of = low;
      const Real end_of = high;
      for (int step = 0; step < 60; ++step) {
        const Real a = low + (high - low) * 0.45L;
        const Real b = low + (high - low) * 0.55L;
        if (sign * rate(a, side) < sign * rate(b, side)) {
          high = b;
        } else {
          low = a;
        }
      }
      if (sign * rate(low, side) < 0.0L) {
        add_between(begin_of, low);
        add_between(low, end_of);
      }
    };
    for (int i = 0; i < n; ++i) {
      const auto k = static_cast<std::size_t>(i);
      add_between(place(i), place(i + 1));
      const Real sign = rates[k][side] > 0.0L ? 1.0L : -1.0L;
      const Real now = sign * rates[k][side];
      const Real next = sign * rates[k + 1][side];
      if (next <= 0.0L) continue;
      const Real before = i > 0 ? sign * rates[k - 1][side] : now;
      const Real after = i + 1 < n ? sign * rates[k + 2][side] : next;
      if (now <= before && next <= after && before > 0.0L && after > 0.0L) {
        add_pair(place(i), place(i + 1), sign);
      }
      if (i > 0 && now < before && now < next && before > 0.0L) {
        add_pair(place(i - 1), place(i + 1), sign);
      }
    }
  }
}

std::vector<Stop> stops_of(const ReferenceLaw& law, const Point& point) {
  std::vector<Stop> stops{{0.0L, false}, {two_pi, false}};
  std::vector<Real> centres;
  if (law.rate != ReferenceRate::constant) {
    for (const Real x : wave_roots(point.u(), 1)) stops.push_back({x, true});
    for (const Real x : wave_roots(point.u(), 2)) stops.push_back({x, false});
  }
  for (const Real kink : point.kinks()) {
    for (const Real x : wave_roots(point.v(), 0, kink)) stops.push_back({x, false});
  }
  if (!point.kinks().empty()) {
    for (const Real x : wave_roots(point.v(), 1)) stops.push_back({x, false});
  }
  for (const Stop& stop : stops) centres.push_back(stop.phase);
  for (const Real centre : centres) {
    for (Real step = 0.5L; step > 1e-19L; step /= 2.5L) {
      for (const Real x : {centre - step, centre + step}) {
        if (x > 0.0L && x < two_pi) stops.push_back({x, false});
      }
    }
  }
  const int n = 48 * static_cast<int>(point.u().sine.size());
  for (int i = 1; i < n; ++i) stops.push_back({two_pi * i / n, false});
  const auto before = [](const Stop& a, const Stop& b) {
    return a.phase < b.phase || (a.phase == b.phase && a.turns && !b.turns);
  };
  std::sort(stops.begin(), stops.end(), before);
  const std::size_t n_stops = stops.size();
  for (std::size_t i = 0; i + 1 < n_stops; ++i) {
    if (stops[i + 1].phase > stops[i].phase) {
      add_extrema(point, stops[i].phase, stops[i + 1].phase, stops);
    }
  }
  std::sort(stops.begin(), stops.end(), before);
  return stops;
}

}  // namespace

contact::SurfaceLaw ReferenceLaw::law() const {
  using contact::FrictionLaw;
  using contact::RoughSurface;
  FrictionLaw friction = FrictionLaw::constant(point.friction_coefficient);
  if (rate == ReferenceRate::exponential) {
    friction = FrictionLaw::exponential(point.friction_coefficient, at_speed, decay);
  } else if (rate == ReferenceRate::hyperbolic) {
    friction = FrictionLaw::hyperbolic(point.friction_coefficient, decay);
  }
  std::optional<RoughSurface> rough;
  if (heights == ReferenceHeights::cubic) rough = RoughSurface::cubic(height);
  if (heights == ReferenceHeights::gaussian) rough = RoughSurface::gaussian(mean, deviation);
  return {point, point.tangential_stiffness, friction, rough, series};
}

double ReferenceLaw::largest_coefficient() const {
  return rate == ReferenceRate::exponential ? std::max(point.friction_coefficient, at_speed)
                                            : point.friction_coefficient;
}

SurfaceReference surface_reference(const ReferenceLaw& law, const Harmonics& motion,
                                   double frequency, int n_harmonics) {
  const Point point(law, motion, frequency);
  const std::vector<Stop> stops = stops_of(law, point);
  return March(point, stops, n_harmonics).run();
}

}  // namespace microslip::test
