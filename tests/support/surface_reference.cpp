#include "support/surface_reference.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "support/surface_reference_point.hpp"

namespace microslip::test {
namespace {

constexpr Real pi = std::numbers::pi_v<Real>;
constexpr Real two_pi = 2.0L * pi;

template <typename F>
Real bisected(const F& positive, Real low, Real high) {
  const bool at_low = positive(low);
  for (int i = 0; i < 80; ++i) {
    const Real middle = (low + high) / 2.0L;
    (positive(middle) == at_low ? low : high) = middle;
  }
  return (low + high) / 2.0L;
}

/// Roots in [begin, end] of f; roots of its derivative are given,
/// so that it is monotone in between.
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
  if (heights == ReferenceHeights::gaussian) rough = RoughSurface::matching_gaussian(height);
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
