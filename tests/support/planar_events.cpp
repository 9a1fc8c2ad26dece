#include "support/planar_events.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace microslip::test {
namespace {

using Real = long double;
using Pair = std::array<Real, 2>;
using State = std::vector<Real>;  // slider, then the integrals of f_p and f_r

constexpr Real two_pi = 2.0L * std::numbers::pi_v<long double>;

Real dot(const Pair& a, const Pair& b) { return a[0] * b[0] + a[1] * b[1]; }
Real norm(const Pair& a) { return std::hypot(a[0], a[1]); }
Pair times(const Pair& a, const Pair& b) { return {a[0] * b[0], a[1] * b[1]}; }

struct Now {
  Pair x{}, rate{}, second{};
  Real normal = 0.0L, normal_rate = 0.0L;
  Real limit = 0.0L, limit_rate = 0.0L;
  State basis;
};

/// Where f of increasing argument first is above 0, between an end where it is not and one where it
/// is.
template <typename Function>
Real first_above(Real low, Real high, const Function& f) {
  for (int i = 0; i < 70; ++i) {
    const Real middle = 0.5L * (low + high);
    (f(middle) > 0.0L ? high : low) = middle;
  }
  return high;
}

class Cycle {
 public:
  explicit Cycle(const EventCase& c) : case_(c), H_(c.point.motion.n_harmonics()) {
    k_ = {c.point.point.tangential_stiffness, c.point.second_stiffness};
    size_ = static_cast<Real>(planar_scale(c.point));
    longest_ = two_pi / (150 * H_);
    y_.assign(static_cast<std::size_t>(2 + 2 * (2 * H_ + 1)), 0.0L);
  }

  EventReference run(int most_periods) {
    EventReference result;
    const std::vector<Pair> contacts = find_contacts();
    for (int period = 0; period < most_periods && !result.settled; ++period) {
      const Pair before = slider();
      std::fill(y_.begin() + 2, y_.end(), 0.0L);
      n_slips_ = 0;
      for (const Pair& contact : contacts) cross(contact[0], contact[1]);
      const Pair moved{slider()[0] - before[0], slider()[1] - before[1]};
      ++result.n_periods;
      result.settled = opens_ || norm(times(k_, moved)) < 1e-15L * size_;
    }
    result.n_slips = n_slips_;
    const auto n = static_cast<std::ptrdiff_t>(2 * H_ + 1);
    result.first.assign(y_.begin() + 2, y_.begin() + 2 + n);
    result.second.assign(y_.begin() + 2 + n, y_.end());
    for (std::vector<Real>* f : {&result.first, &result.second}) {
      for (Real& x : *f) x *= 2.0L / two_pi;
      f->front() *= 0.5L;
    }
    return result;
  }

 private:
  [[nodiscard]] Pair slider() const { return {y_[0], y_[1]}; }

  [[nodiscard]] Now at(Real phase) const {
    const auto& rows = case_.point.motion.rows();
    const contact::PointParameters& p = case_.point.point;
    Now now;
    now.x = {rows(0, 0), rows(0, 2)};
    Real v = rows(0, 1);
    Real v_rate = 0.0L;
    now.basis.assign(static_cast<std::size_t>(2 * H_ + 1), 1.0L);
    for (int h = 1; h <= H_; ++h) {
      const Real s = std::sin(h * phase);
      const Real c = std::cos(h * phase);
      now.basis[static_cast<std::size_t>(2 * h - 1)] = s;
      now.basis[static_cast<std::size_t>(2 * h)] = c;
      const auto value = [&](int i) { return rows(2 * h - 1, i) * s + rows(2 * h, i) * c; };
      const auto slope = [&](int i) { return h * (rows(2 * h - 1, i) * c - rows(2 * h, i) * s); };
      for (std::size_t i = 0; i < 2; ++i) {
        const int column = i == 0 ? 0 : 2;
        now.x[i] += value(column);
        now.rate[i] += slope(column);
        now.second[i] -= static_cast<Real>(h * h) * value(column);
      }
      v += value(1);
      v_rate += slope(1);
    }
    now.normal = p.rest_load + p.normal_stiffness * v;
    now.normal_rate = p.normal_stiffness * v_rate;
    const Real speed = norm(now.rate);
    const Real falling = (p.friction_coefficient - case_.kinetic) * std::exp(-case_.rate * speed);
    const bool constant = case_.rate == 0.0;
    const Real mu = constant ? Real{p.friction_coefficient} : case_.kinetic + falling;
    const Real speed_rate = speed > 0.0L ? dot(now.rate, now.second) / speed : 0.0L;
    const Real mu_rate = constant ? 0.0L : -case_.rate * falling * speed_rate;
    now.limit = mu * now.normal;
    now.limit_rate = mu * now.normal_rate + mu_rate * now.normal;
    return now;
  }

  [[nodiscard]] Pair force(const Now& now, const Pair& s) const {
    return times(k_, {now.x[0] - s[0], now.x[1] - s[1]});
  }

  /// λ of (1) and e.
  [[nodiscard]] Real slip_rate(const Now& now, const Pair& s, Pair& e) const {
    e = force(now, s);
    const Real size = norm(e);
    e = {e[0] / size, e[1] / size};
    return (dot(e, times(k_, now.rate)) - now.limit_rate) / dot(e, times(k_, e));
  }

  /// Contact begins with its begin and end; the whole period where there is no separation.
  std::vector<Pair> find_contacts() {
    const int n = 4000 * H_;
    const auto normal = [this](Real phase) { return at(phase).normal; };
    std::vector<Pair> contacts;
    for (int i = 0; i < n; ++i) {
      const Real low = two_pi * i / n;
      const Real high = two_pi * (i + 1) / n;
      if (!(normal(low) <= 0.0L && normal(high) > 0.0L)) continue;
      const Real begin = first_above(low, high, normal);
      Real end = high;
      while (normal(end) > 0.0L) end += two_pi / n;
      end = first_above(end - two_pi / n, end, [&](Real x) { return -normal(x); });
      contacts.push_back({begin, end});
    }
    opens_ = !contacts.empty();
    if (!opens_ && normal(0.0L) > 0.0L) contacts.push_back({0.0L, two_pi});
    return contacts;
  }

  void cross(Real begin, Real end) {
    time_ = begin;
    end_ = end;
    const bool slips = opens_ ? touch_down(end - begin) : come_back();
    if (opens_) end_ -= 1e-8L * (end - begin);  // the limit vanishes: f is known to be less
    bool slipping = slips;
    while (time_ < end_) {
      if (slipping) ++n_slips_;
      slipping ? slip() : stick();
      slipping = !slipping;
    }
  }

  /// Whether contact begins in slip. If so the slider is put on the regular solution a little
  /// later.
  bool touch_down(Real length) {
    const Now now = at(time_);
    const Pair pull = times(k_, now.rate);
    y_[0] = now.x[0];
    y_[1] = now.x[1];
    if (norm(pull) <= now.limit_rate) return false;
    const auto over = [&](Real rho) {
      return now.limit_rate -
             norm({pull[0] / (1.0L + rho * k_[0]), pull[1] / (1.0L + rho * k_[1])});
    };
    Real most = 1.0L;
    while (over(most) <= 0.0L) most *= 2.0L;
    const Real rho = first_above(0.0L, most, over);
    Pair e{pull[0] / (1.0L + rho * k_[0]), pull[1] / (1.0L + rho * k_[1])};
    const Real size = norm(e);
    time_ += 1e-8L * length;
    const Now later = at(time_);
    for (std::size_t i = 0; i < 2; ++i) y_[i] = later.x[i] - later.limit * e[i] / size / k_[i];
    return true;
  }

  /// Brings a slider outside its ellipse back; whether it slips then.
  bool come_back() {
    const Now now = at(time_);
    const Pair trial = force(now, slider());
    const Real excess = norm(trial) - now.limit;
    if (excess < -1e-15L * size_) return false;
    if (excess > 0.0L) {
      const auto returned = [&](Real a) {
        return Pair{trial[0] / (1.0L + a * k_[0]), trial[1] / (1.0L + a * k_[1])};
      };
      Real most = 1.0L / std::max(k_[0], k_[1]);
      while (norm(returned(most)) > now.limit) most *= 2.0L;
      const Pair f =
          returned(first_above(0.0L, most, [&](Real a) { return now.limit - norm(returned(a)); }));
      for (std::size_t i = 0; i < 2; ++i) y_[i] = now.x[i] - f[i] / k_[i];
    }
    Pair e;
    return slip_rate(now, slider(), e) > 0.0L;
  }

  /// How far the spring of a resting slider is beyond the limit.
  [[nodiscard]] Real excess_at(Real phase) const {
    const Now now = at(phase);
    return norm(force(now, slider())) - now.limit;
  }

  /// The largest excess between two phases that have one maximum between them, and its phase.
  [[nodiscard]] Pair highest_between(Real low, Real high) const {
    constexpr Real golden = 0.381966011250105151795413165634L;
    Real a = low + golden * (high - low);
    Real b = high - golden * (high - low);
    Real at_a = excess_at(a);
    Real at_b = excess_at(b);
    for (int i = 0; i < 40; ++i) {  // the top is flat: 8 digits of its phase give 16 of its height
      if (at_a > at_b) {
        high = std::exchange(b, a);
        at_b = at_a;
        a = low + golden * (high - low);
        at_a = excess_at(a);
      } else {
        low = std::exchange(a, b);
        at_a = at_b;
        b = high - golden * (high - low);
        at_b = excess_at(b);
      }
    }
    return at_a > at_b ? Pair{a, at_a} : Pair{b, at_b};
  }

  void stick() {
    const Real nothing = 1e-18L * size_;
    const auto over = [&](Real phase) { return excess_at(phase) - nothing; };
    Real until = end_;
    const Real fine = longest_ / 16.0L;
    Real before = time_;
    Real guard_before = over(before);
    Real guard = guard_before;
    bool left = guard < -20.0L * nothing;  // the edge, on which stick begins
    for (Real from = time_; from < end_; from += fine) {
      const Real to = std::min(from + fine, end_);
      const Real next = over(to);
      const bool peak = guard > guard_before && guard >= next && from > time_;
      const Pair top = peak && left && guard <= 0.0L ? highest_between(before, to) : Pair{to, next};
      if (left && top[1] > (peak ? nothing : 0.0L)) {
        until = first_above(peak ? before : from, top[0], over);
        break;
      }
      if (!left && next > 0.0L) {  // off the edge and back within this cell
        Real inside = to;
        for (int i = 0; i < 40 && over(inside) > 0.0L; ++i) inside = from + 0.5L * (inside - from);
        until = first_above(inside, to, over);
        break;
      }
      left = left || next < -20.0L * nothing;
      before = from;
      guard_before = guard;
      guard = next;
    }
    advance(until, false);
  }

  void slip() { advance(end_, true); }

  [[nodiscard]] State rate_of(Real phase, const State& y, bool slips) const {
    const Now now = at(phase);
    const Pair s{y[0], y[1]};
    State rate(y.size(), 0.0L);
    const Pair f = force(now, s);
    if (slips) {
      Pair e;
      const Real lambda = slip_rate(now, s, e);
      rate[0] = lambda * e[0];
      rate[1] = lambda * e[1];
    }
    const std::size_t n = now.basis.size();
    for (std::size_t i = 0; i < n; ++i) {
      rate[2 + i] = now.basis[i] * f[0];
      rate[2 + n + i] = now.basis[i] * f[1];
    }
    return rate;
  }

  /// One step; returns the difference of the last two orders.
  Real extrapolate(Real length, bool slips, State& result) const {
    constexpr int n_columns = 6;
    std::array<std::vector<State>, n_columns> table;
    for (int i = 0; i < n_columns; ++i) {
      const auto row = static_cast<std::size_t>(i);
      table[row].push_back(midpoint(length, 2 * (i + 1), slips));
      for (int j = 1; j <= i; ++j) {
        const Real ratio = static_cast<Real>(i + 1) / (i + 1 - j);
        const State& fine = table[row].back();
        const State& coarse = table[row - 1][static_cast<std::size_t>(j - 1)];
        State next(fine.size());
        for (std::size_t k = 0; k < fine.size(); ++k) {
          next[k] = fine[k] + (fine[k] - coarse[k]) / (ratio * ratio - 1.0L);
        }
        table[row].push_back(std::move(next));
      }
    }
    result = table[n_columns - 1].back();
    const State& lower = table[n_columns - 1][n_columns - 2];
    Real error = 0.0L;
    for (std::size_t k = 0; k < result.size(); ++k) {
      const Real unit = k < 2 ? k_[k] : 1.0L;
      error = std::max(error, unit * std::abs(result[k] - lower[k]));
    }
    return error;
  }

  [[nodiscard]] State midpoint(Real length, int n, bool slips) const {
    const Real h = length / n;
    State before = y_;
    State now = y_;
    State rate = rate_of(time_, y_, slips);
    for (std::size_t k = 0; k < now.size(); ++k) now[k] += h * rate[k];
    for (int i = 1; i < n; ++i) {
      rate = rate_of(time_ + h * i, now, slips);
      for (std::size_t k = 0; k < now.size(); ++k) {
        const Real next = before[k] + 2.0L * h * rate[k];
        before[k] = now[k];
        now[k] = next;
      }
    }
    rate = rate_of(time_ + length, now, slips);
    for (std::size_t k = 0; k < now.size(); ++k) now[k] = 0.5L * (before[k] + now[k] + h * rate[k]);
    return now;
  }

  /// To a phase, or to the end of slip.
  void advance(Real until, bool slips) {
    Real length = longest_;
    State next;
    while (time_ < until) {
      length = std::min({length, longest_, until - time_});
      const Real error = extrapolate(length, slips, next);
      if (!(error <= 1e-15L * size_) && length > 1e-13L) {
        length *= 0.5L;
        continue;
      }
      const auto falls = [&](Real part) {
        Pair e;
        State there;
        extrapolate(part, true, there);
        return -slip_rate(at(time_ + part), {there[0], there[1]}, e);
      };
      Pair e;
      if (slips && slip_rate(at(time_ + length), {next[0], next[1]}, e) < 0.0L) {
        const Real part = first_above(0.0L, length, falls);
        extrapolate(part, true, next);
        y_ = next;
        time_ += part;
        return;
      }
      y_ = next;
      time_ = length >= until - time_ ? until : time_ + length;
      length *= 1.6L;
    }
  }

  const EventCase& case_;
  int H_;
  Pair k_{};
  Real size_ = 0.0L;
  Real longest_ = 0.0L;
  Real time_ = 0.0L;
  Real end_ = 0.0L;
  State y_;
  int n_slips_ = 0;
  bool opens_ = false;
};

}  // namespace

EventReference planar_events(const EventCase& c, int most_periods) {
  return Cycle(c).run(most_periods);
}

}  // namespace microslip::test
