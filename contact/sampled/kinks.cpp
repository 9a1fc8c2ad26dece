#include "contact/sampled/kinks.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace microslip::contact::sampled {
namespace {

double at(const double* column, std::size_t i) { return column[i * block_size]; }

/// 1 along positive friction, −1 against it, 0: it sticks.
double side_of(InstantState state) {
  if (state == InstantState::positive_slip) return 1.0;
  return state == InstantState::negative_slip ? -1.0 : 0.0;
}

Slopes slopes_at(const StepSpline& w, double x, double factor) {
  return {factor * w.slope_at(x), factor * w.bend_at(x), factor * 6.0 * w.cube};
}

/// Where side (w − level) becomes positive between two places, for good; by Newton's method from
/// the chord, kept between the last places on both sides.
double rises_above(const StepSpline& w, double level, double side, double from, double to) {
  const double depth = side * (level - w.at(from));
  const double height = side * (w.at(to) - level);
  if (!(height > 0.0)) return to;
  if (!(depth > 0.0)) return from;
  double low = from;
  double high = to;
  double x = from + (to - from) * depth / (depth + height);
  for (int i = 0; i < 50; ++i) {
    const double above = side * (w.at(x) - level);
    (above > 0.0 ? high : low) = x;
    const double slope = side * w.slope_at(x);
    const double middle = 0.5 * (low + high);
    double next = slope > 0.0 ? x - above / slope : middle;
    if (next < low || next > high) next = middle;
    const double way = std::abs(next - x);
    x = next;
    if (way < 1e-8 && next != middle) break;  // the next one would be its square
    if (way < 1e-14) break;
  }
  return x;
}

/// Where w returns to what it is at a place from which it leaves against `side`.
double returns(const StepSpline& w, double side, double from, double to) {
  const double slope = side * w.slope_at(from);
  const double half_bend = side * 0.5 * w.bend_at(from);
  const double cube = side * w.cube;
  const double root = std::sqrt(std::max(half_bend * half_bend - 4.0 * slope * cube, 0.0));
  const double below = half_bend + root;
  return below > 0.0 ? std::clamp(from - 2.0 * slope / below, from, to) : from;
}

/// The step in which a run ends, followed from its begin on.
class Step {
 public:
  Step(const SmoothPoint& point, const LineColumns& columns, std::size_t now, std::size_t n,
       std::vector<Kink>& kinks)
      : point_(point),
        columns_(columns),
        now_(now),
        before_(now > 0 ? now - 1 : n - 1),
        u_(around_step(columns.u, now, n)),
        r_(around_step(columns.closeness, now, n)),
        kinks_(kinks) {}

  void end(const Run& from, const Run& to) {
    slider_ = at(columns_.slider, before_);
    side_ = side_of(from.state);
    if (from.state == InstantState::separated) {
      close(to);
    } else if (to.state == InstantState::separated) {
      open();
    } else {
      rub(to);
    }
  }

 private:
  /// Through contact, to what it does at the instant behind.
  void rub(const Run& to) {
    if (point_.tangential_stiffness == 0.0) return;
    const double last = to.turned ? 0.0 : side_of(to.state);
    const double turn = at(columns_.turns, now_);
    double side = side_;
    if (side == 0.0) side = turn == 0.0 ? last : (turn == 1.0 || turn == 3.0 ? 1.0 : -1.0);
    // One end may turn twice within the step: then slip begins on its side once more.
    for (int i = 0; i < 3 && side != 0.0; ++i, side = -side) {
      const bool turning = i < 2 && turns(side);
      if (side_ == side && last == side && !turning) return;
      if (side_ != side) {
        const double height = turning ? turned_to(side) : band_end(side).at(1.0);
        if (!(side * (height - slider_) > 0.0)) continue;
        begin_slip(side, turning ? std::max(band_end(side).turn(side), place_) : 1.0);
        if (!turning) return;
      }
      end_slip(side);
    }
  }

  void begin_slip(double side, double latest) {
    const StepSpline w = band_end(side);
    const bool landed = left_by_ == Kink::Slider::landing;
    const double place =
        landed ? returns(w, side, place_, latest) : rises_above(w, slider_, side, place_, latest);
    Kink& kink = add(Kink::Kind::slips, place, side);
    kink.slider = left_by_;
    kink.turn = turn_;
    kink.friction = slopes_at(w, kink.share, -point_.tangential_stiffness);
    side_ = side;
  }

  /// Where the end of the band turns in the step, or has turned at its begin.
  void end_slip(double side) {
    const StepSpline w = band_end(side);
    const bool here = turns(side);
    Kink& kink = add(Kink::Kind::ends_slip, here ? std::max(w.turn(side), place_) : place_, side);
    kink.friction = slopes_at(w, kink.share, point_.tangential_stiffness);
    kink.friction[0] = 0.0;
    slider_ = here ? turned_to(side) : w.at(kink.share);
    side_ = 0.0;
    left_by_ = Kink::Slider::turn;
    turn_ = kink.share;
  }

  void close(const Run& to) {
    const double rise = at(columns_.closeness, now_) - at(columns_.closeness, before_);
    Kink& kink = add(Kink::Kind::closes, r_.rise_through_zero(rise), 0.0);
    const double k_u = point_.tangential_stiffness;
    kink.load = slopes_at(r_, kink.share, 1.0);
    const double pull = k_u * u_.slope_at(kink.share);
    const double limit = point_.friction_coefficient * std::max(kink.load[0], 0.0);
    slider_ = u_.at(kink.share);
    left_by_ = Kink::Slider::landing;
    side_ = 0.0;
    const double side = pull < 0.0 ? -1.0 : 1.0;
    const bool rests = to.state == InstantState::stick && !turns(side);
    if (std::abs(pull) < limit || rests) {
      kink.friction = slopes_at(u_, kink.share, k_u);
    } else {
      kink.side = side_ = side;
      kink.friction = slopes_at(r_, kink.share, side * point_.friction_coefficient);
    }
    rub(to);
  }

  void open() {
    const double fall = at(columns_.closeness, before_) - at(columns_.closeness, now_);
    const double place = r_.negated().rise_through_zero(fall);
    const bool rubs = point_.tangential_stiffness > 0.0;
    if (rubs && side_ == 0.0) {
      begin_slip(u_.at(place) < slider_ ? -1.0 : 1.0, place);
    }
    Kink& kink = add(Kink::Kind::opens, place, side_);
    kink.load = slopes_at(r_, place, -1.0);
    kink.friction = slopes_at(r_, place, -side_ * point_.friction_coefficient);
  }

  Kink& add(Kink::Kind kind, double place, double side) {
    Kink& kink = kinks_.emplace_back();
    kink.kind = kind;
    kink.now = now_;
    kink.share = place_ = place;
    kink.side = side;
    return kink;
  }

  [[nodiscard]] bool turns(double side) const {
    const double turn = at(columns_.turns, now_);
    return turn > 2.5 || turn == (side > 0.0 ? 1.0 : 2.0);
  }
  [[nodiscard]] double turned_to(double side) const {
    return at(side > 0.0 ? columns_.low : columns_.high, now_);
  }
  /// w along positive friction.
  [[nodiscard]] StepSpline band_end(double side) const {
    return u_.plus(-side * point_.compliance(), r_);
  }

  const SmoothPoint& point_;
  const LineColumns& columns_;
  std::size_t now_;
  std::size_t before_;
  StepSpline u_;
  StepSpline r_;
  std::vector<Kink>& kinks_;
  double place_ = 0.0;
  double side_ = 0.0;  // of slip
  double slider_ = 0.0;
  Kink::Slider left_by_ = Kink::Slider::run;
  double turn_ = 0.0;
};

/// Splines go on with the same slope alone from one step to the next, which tells where a stick
/// lasts for less than one: then the force bends so much.
Kink passed(const SmoothPoint& point, const LineColumns& columns, std::size_t now, std::size_t n) {
  const StepSpline u(around_step(columns.u, now, n));
  const StepSpline next(around_step(columns.u, now + 1 < n ? now + 1 : 0, n));
  const double k_u = point.tangential_stiffness;
  Kink kink;
  kink.kind = Kink::Kind::passes;
  kink.now = now;
  kink.share = 1.0;
  kink.friction = {0.0, k_u * (next.bend_at(0.0) - u.bend_at(1.0)),
                   6.0 * k_u * (next.cube - u.cube)};
  return kink;
}

/// The cubics of Lagrange through t = −1, 0, 1, 2 with three derivatives, [order][place].
using LagrangeBasis = std::array<std::array<double, 4>, 4>;

LagrangeBasis lagrange(double x) {
  const std::array<double, 4> t{x + 1.0, x, x - 1.0, x - 2.0};
  constexpr std::array<double, 4> factor{-1.0 / 6.0, 0.5, -0.5, 1.0 / 6.0};
  LagrangeBasis basis{};
  for (std::size_t j = 0; j < 4; ++j) {
    const double p = t[j > 0 ? 0 : 1];
    const double q = t[j > 1 ? 1 : 2];
    const double r = t[j > 2 ? 2 : 3];
    basis[0][j] = factor[j] * p * q * r;
    basis[1][j] = factor[j] * (p * q + (p + q) * r);
    basis[2][j] = factor[j] * 2.0 * (p + q + r);
    basis[3][j] = factor[j] * 6.0;
  }
  return basis;
}

void take_off(const Slopes& c, const KinkMoments& moments, const LagrangeBasis& basis,
              const std::array<std::size_t, 4>& at, double* column) {
  std::array<double, 4> error{};
  for (std::size_t l = 0; l < moments.size(); ++l) {
    const double moment = moments[l][0] * c[0] + moments[l][1] * c[1] + moments[l][2] * c[2];
    for (std::size_t j = 0; j < 4; ++j) error[j] += moment * basis[l][j];
  }
  for (std::size_t j = 0; j < 4; ++j) column[at[j] * block_size] -= error[j];
}

}  // namespace

std::array<double, 4> end_of_band(const SmoothPoint& point, const LineColumns& columns, double side,
                                  std::size_t now, std::size_t n) {
  std::array<double, 4> w = around_step(columns.u, now, n);
  const std::array<double, 4> r = around_step(columns.closeness, now, n);
  for (std::size_t j = 0; j < w.size(); ++j) w[j] += side * point.compliance() * r[j];
  return w;
}

KinkMoments kink_moments(double x) {
  // β_1 … β_6, by B_{m+1}(x) in y = x (1 − x) and z = x − 1/2.
  const double y = x * (1.0 - x);
  const double z = x - 0.5;
  const std::array<double, 6> beta{
      -(1.0 / 6.0 - y) / 2.0,
      -y * z / 6.0,
      -(y * y - 1.0 / 30.0) / 24.0,
      z * y * (y + 1.0 / 3.0) / 120.0,
      -(1.0 / 42.0 - y * y * (0.5 + y)) / 720.0,
      -z * y * (y * y + y + 1.0 / 3.0) / 5040.0,
  };
  constexpr std::array<std::array<double, 3>, 4> choose{
      {{1.0, 1.0, 1.0}, {2.0, 3.0, 4.0}, {3.0, 6.0, 10.0}, {4.0, 10.0, 20.0}}};
  KinkMoments moments{};
  for (std::size_t l = 0; l < 4; ++l) {
    for (std::size_t i = 0; i < 3; ++i) moments[l][i] = choose[l][i] * beta[i + l];
  }
  return moments;
}

void find_kinks(const SmoothPoint& point, const std::vector<Run>& runs, const LineColumns& columns,
                std::size_t n, Kinks& kinks) {
  kinks.all.clear();
  kinks.first.clear();
  if (runs.size() < 2) return;
  kinks.first.push_back(0);
  for (std::size_t j = 0; j < runs.size(); ++j) {
    const Run& run = runs[j];
    const Run& next = runs[j + 1 < runs.size() ? j + 1 : 0];
    Step(point, columns, next.begin, n, kinks.all).end(run, next);
    if (run.state == InstantState::stick && run.length == 1) {
      kinks.all.push_back(passed(point, columns, run.begin, n));
    }
    kinks.first.push_back(kinks.all.size());
  }
}

void find_load_kinks(const double* closeness, std::size_t n, Kinks& kinks) {
  kinks.all.clear();
  kinks.first.clear();
  for (std::size_t now = 0, before = n - 1; now < n; before = now++) {
    const bool closes = at(closeness, now) > 0.0;
    if (closes == (at(closeness, before) > 0.0)) continue;
    const StepSpline r(around_step(closeness, now, n));
    const double rise = at(closeness, now) - at(closeness, before);
    Kink& kink = kinks.all.emplace_back();
    kink.kind = closes ? Kink::Kind::closes : Kink::Kind::opens;
    kink.now = now;
    kink.share = closes ? r.rise_through_zero(rise) : r.negated().rise_through_zero(-rise);
    kink.load = slopes_at(r, kink.share, closes ? 1.0 : -1.0);
  }
}

void add_load_moments(const Kink& kink, double normal_stiffness, const Instants& instants,
                      std::vector<double>& moments) {
  const double sign = kink.kind == Kink::Kind::closes ? 1.0 : -1.0;
  const double x = kink.share;
  const double weight = sign * normal_stiffness * (0.5 - x);
  const double* begin = instants.moment_basis(kink.now > 0 ? kink.now - 1 : instants.size() - 1);
  const double* end = instants.moment_basis(kink.now);
  for (std::size_t m = 0; m < moments.size(); ++m) {
    moments[m] += weight * ((1.0 - x) * begin[m] + x * end[m]);
  }
}

void mend(const Kinks& kinks, std::size_t n, double* friction, double* normal) {
  for (const Kink& kink : kinks.all) {
    const KinkMoments moments = kink_moments(kink.share);
    const LagrangeBasis basis = lagrange(kink.share);
    const auto around = instants_around(kink.now, n);
    if (kink.friction != Slopes{}) take_off(kink.friction, moments, basis, around, friction);
    if (kink.load[0] != 0.0) take_off(kink.load, moments, basis, around, normal);
  }
}

}  // namespace microslip::contact::sampled
