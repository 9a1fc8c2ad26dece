#include "contact/sampled/line_point.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "contact/sampled/step_spline.hpp"

namespace microslip::contact::sampled {
namespace {

void add(std::vector<double>& sum, double factor, const double* terms) {
  for (std::size_t m = 0; m < sum.size(); ++m) sum[m] += factor * terms[m];
}

/// 0 where nothing rises.
double ratio_of(double a, double b) { return b == 0.0 ? 0.0 : a / b; }

/// β_0 of kinks.hpp (1).
double end_moment(double x) { return x - 0.5; }

double sign_of(InstantState state) { return state == InstantState::negative_slip ? -1.0 : 1.0; }

}  // namespace

/// ds of (2) as a function of û and v̂: u at a place between four instants and what follows from
/// it.
struct LineDerivatives::Anchor {
  std::size_t first = 0;  // instants, counted on over n
  std::array<double, 4> share{1.0, 0.0, 0.0, 0.0};
  double by_approach = 0.0;
  double by_rate = 0.0;  // at the first
  double by_frequency = 0.0;
};

void LineDerivatives::reset(const Instants& instants) {
  instants_ = &instants;
  n_rows_ = instants.n_rows();
  size_ = {n_rows_, n_rows_, n_rows_, n_rows_ + product_slack};
  for (auto* matrix : {&by_u_, &by_v_}) matrix->sum.assign(n_rows_ * size_.stride, 0.0);
  by_frequency_.resize(n_rows_);
  for (auto* moments : {&stick_, &limit_, &rate_, &normal_, &part_}) {
    moments->resize(instants.n_moments());
  }
  for (auto* row : {&phase_, &b_, &moved_, &row_}) row->resize(n_rows_);
  products_.reset(instants.n_harmonics());
}

void LineDerivatives::clear() {
  for (auto* matrix : {&by_u_, &by_v_}) matrix->clear();
  for (auto* sum : {&by_frequency_, &stick_, &limit_, &rate_, &normal_}) {
    std::fill(sum->begin(), sum->end(), 0.0);
  }
}

void LineDerivatives::OuterSum::push(const ProductSizes& size, double factor,
                                     const std::vector<double>& a, const std::vector<double>& b) {
  if (factor == 0.0) return;
  ++n;
  if (left.size() < n * size.phi_stride) left.resize(n * size.phi_stride);
  if (right.size() < n * size.stride) right.resize(n * size.stride);
  double* to = left.data() + (n - 1) * size.phi_stride;
  for (std::size_t k = 0; k < size.n_left; ++k) to[k] = factor * a[k];
  std::copy_n(b.data(), size.n_columns, right.data() + (n - 1) * size.stride);
}

void LineDerivatives::OuterSum::add_up(const ProductSizes& size) {
  product_kernels().product(size, n, left.data(), right.data(), sum.data());
}

void LineDerivatives::add_outer(const std::vector<double>& a, const std::vector<double>& b,
                                double factor_u, double factor_v) {
  by_u_.push(size_, factor_u, a, b);
  by_v_.push(size_, factor_v, a, b);
}

void LineDerivatives::add_anchor(const Anchor& anchor, const std::vector<double>& a) {
  std::fill(b_.begin(), b_.end(), 0.0);
  std::size_t instant = anchor.first;
  for (const double share : anchor.share) {
    if (share != 0.0) add(b_, share, instants_->basis(instant));
    instant = instant + 1 < instants_->size() ? instant + 1 : 0;
  }
  add_outer(a, b_, 1.0, anchor.by_approach);
  if (anchor.by_rate != 0.0) {
    const double* rates = instants_->rates(anchor.first);
    b_.assign(rates, rates + n_rows_);
    add_outer(a, b_, anchor.by_rate, 0.0);
  }
  if (anchor.by_frequency != 0.0) add(by_frequency_, anchor.by_frequency, a.data());
}

LineDerivatives::Anchor LineDerivatives::landing(std::size_t before, std::size_t now,
                                                 double closeness_by_approach,
                                                 const LineColumns& columns) const {
  const double r0 = columns.closeness[before * block_size];
  const double change = columns.closeness[now * block_size] - r0;
  const double way = columns.u[now * block_size] - columns.u[before * block_size];
  const double x = -r0 / change;
  return {.first = before,
          .share = {1.0 - x, x, 0.0, 0.0},
          .by_approach = -way * closeness_by_approach / change};
}

/// As the kernel lands (lanes/line_kernels.cpp), by four instants.
LineDerivatives::Anchor LineDerivatives::smooth_landing(std::size_t now, double normal_stiffness,
                                                        const LineColumns& columns) const {
  const std::size_t n = instants_->size();
  const std::array<double, 4> around = around_step(columns.closeness, now, n);
  const StepSpline r(around);
  const StepSpline u(around_step(columns.u, now, n));
  const double x = r.rise_through_zero(around[2] - around[1]);
  const double rise = std::max(r.slope_at(x), 0.25 * (around[2] - around[1]));
  return {.first = (now + n - 2) % n,
          .share = StepSpline::shares(x),
          .by_approach = -u.slope_at(x) / rise * normal_stiffness};
}

/// Where an end of the band took the slider: at an instant, or where it turned in the step before.
LineDerivatives::Anchor LineDerivatives::pushed(std::size_t now, const LineColumns& columns) const {
  const std::size_t n = instants_->size();
  const std::size_t at = now * block_size;
  const double width = point_.compliance() * point_.normal_stiffness;
  const bool by_low = columns.slider[at] == columns.low[at];
  const bool by_high = columns.slider[at] == columns.high[at];
  if (columns.turns[at] == 0.0 || !(by_low || by_high)) {
    return {.first = now, .by_approach = columns.slider[at] < columns.u[at] ? -width : width};
  }
  const double side = by_low ? -1.0 : 1.0;
  const StepSpline end(end_of_band(point_, columns, side, now, n));
  return {.first = (now + n - 2) % n,
          .share = StepSpline::shares(end.turn(-side)),
          .by_approach = side * width};
}

/// Where a point that sticks throughout had its slider pushed to where it is; n: nowhere.
std::size_t LineDerivatives::last_push(const LineColumns& columns) const {
  const std::size_t n = instants_->size();
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t at = i * block_size;
    if (columns.slider[at] == columns.low[at] || columns.slider[at] == columns.high[at]) return i;
  }
  return n;
}

/// Writes every entry: the weights, then the sums that wait.
void LineDerivatives::sum_up(double frequency) {
  products_.set(stick_.data());
  for (std::size_t k = 0; k < n_rows_; ++k) {
    products_.row(k, by_u_.sum.data() + k * size_.stride);
  }
  products_.set(limit_.data());
  for (std::size_t k = 0; k < n_rows_; ++k) {
    products_.row(k, by_v_.sum.data() + k * size_.stride);
  }
  for (auto* matrix : {&by_u_, &by_v_}) matrix->add_up(size_);
  if (frequency == 0.0) return;
  // (sin bθ)' = b cos bθ and so on.
  const std::size_t H = n_rows_ / 2;
  products_.set(rate_.data());
  for (std::size_t k = 0; k < n_rows_; ++k) {
    products_.row(k, row_.data());
    double* to = by_u_.sum.data() + k * size_.stride;
    for (std::size_t b = 1; b <= H; ++b) {
      to[b] += static_cast<double>(b) * row_[H + b];
      to[H + b] -= static_cast<double>(b) * row_[b];
    }
  }
}

/// Moments of the instants of a run.
void LineDerivatives::sum_part(const Run& run) {
  const std::size_t n = instants_->size();
  const std::size_t end = run.begin + run.length;
  std::fill(part_.begin(), part_.end(), 0.0);
  add(part_, 1.0, instants_->sums(std::min(end, n)));
  add(part_, -1.0, instants_->sums(run.begin));
  if (end > n) add(part_, 1.0, instants_->sums(end - n));
}

void LineDerivatives::smooth(const SmoothPoint& point, const std::vector<Run>& runs,
                             const Kinks& kinks, const LineColumns& columns) {
  clear();
  point_ = point;
  const double limit = point.friction_coefficient * point.normal_stiffness;
  for (std::size_t j = 0; j < runs.size(); ++j) {
    const Run& run = runs[j];
    std::fill(phase_.begin(), phase_.end(), 0.0);
    if (run.state != InstantState::separated) {
      sum_part(run);
      add(normal_, point.normal_stiffness, part_.data());
    }
    const bool sticks = run.state == InstantState::stick;
    if (sticks) hold_part();
    if (slips(run.state)) add(limit_, sign_of(run.state) * limit, part_.data());
    add_kinks(kinks.at_end_of(j), columns);
    if (sticks && point.tangential_stiffness > 0.0) add_stuck(run, columns);
  }
  sum_up(0.0);
}

void LineDerivatives::add_kinks(std::span<const Kink> kinks, const LineColumns& columns) {
  for (const Kink& kink : kinks) {
    switch (kink.kind) {
      case Kink::Kind::slips:
      case Kink::Kind::ends_slip:
        add_slip(kink, columns);
        break;
      case Kink::Kind::closes:
      case Kink::Kind::opens:
        add_contact(kink);
        break;
      case Kink::Kind::passes:  // of higher order
        break;
    }
  }
}

/// k (u − s) of the instants of the run, the part of s in `phase_`.
void LineDerivatives::hold_part() {
  const std::size_t H = n_rows_ / 2;
  const double k_u = point_.tangential_stiffness;
  add(stick_, k_u, part_.data());
  phase_[0] = -k_u * part_[0];
  for (std::size_t h = 1; h <= H; ++h) {
    phase_[h] = -k_u * part_[2 * H + h];
    phase_[H + h] = -k_u * part_[h];
  }
}

/// `phase_` times the motion of s in a run.
void LineDerivatives::add_stuck(const Run& run, const LineColumns& columns) {
  const std::size_t n = instants_->size();
  const std::size_t before = (run.begin + n - 1) % n;
  if (run.length == n) {
    const std::size_t i = last_push(columns);
    if (i < n && columns.slider[0] != 0.0) add_anchor(pushed(i, columns), phase_);
  } else if (run.turned) {
    add_anchor(pushed(run.begin, columns), phase_);
  } else if (columns.closeness[before * block_size] <= 0.0) {
    add_anchor(smooth_landing(run.begin, point_.normal_stiffness, columns), phase_);
  } else {
    add_anchor(pushed(before, columns), phase_);
  }
}

/// What mend() takes off, with T a line between the two instants around the kink.
/// With c = q (w − s) the derivative of (1) of kinks.hpp is
///
///   q Σ_i dw^(i)(x) Σ_l C(i+l, l) β_{i+l} T^(l)(x) − q ds Σ_l β_l T^(l)(x)
///
/// from i = 0 on: that of the place is in it, for dβ_m/dx = −β_{m−1}.
/// @param by_u, by_v  q times dw by u and by v.
/// @param moves       whether dw(x) moves the place; else i = 1, …. What ds does is added
///                    elsewhere.
void LineDerivatives::add_kink(const Kink& kink, double by_u, double by_v, bool moves) {
  const double x = kink.share;
  const KinkMoments moments = kink_moments(x);
  const std::array orders{StepSpline::slope_shares(x), StepSpline::bend_shares(x),
                          StepSpline::third_shares};
  const std::array<double, 4> here = StepSpline::shares(x);
  const std::array<double, 2> value{1.0 - x, x};
  constexpr std::array<double, 2> slope{-1.0, 1.0};
  for (std::size_t k = 0; k < value.size(); ++k) {
    std::array<double, 4> weights{};
    for (std::size_t j = 0; j < weights.size(); ++j) {
      weights[j] = moves ? -(end_moment(x) * value[k] + moments[0][0] * slope[k]) * here[j] : 0.0;
      for (std::size_t i = 0; i < orders.size(); ++i) {
        weights[j] -= (value[k] * moments[0][i] + slope[k] * moments[1][i]) * orders[i][j];
      }
    }
    sum_around(kink.now, weights);
    const double* T = instants_->basis(k == 0 ? before(kink.now) : kink.now);
    moved_.assign(T, T + n_rows_);
    add_outer(moved_, b_, by_u, by_v);
  }
}

/// Of the basis at the four instants around a step, to `b_`.
void LineDerivatives::sum_around(std::size_t now, const std::array<double, 4>& weights) {
  const std::array<std::size_t, 4> at = instants_around(now, instants_->size());
  std::fill(b_.begin(), b_.end(), 0.0);
  for (std::size_t j = 0; j < weights.size(); ++j) add(b_, weights[j], instants_->basis(at[j]));
}

/// Σ_l β_l T^(l)(x), T a line between the two instants, times a factor, to `moved_`.
void LineDerivatives::at_kink(const Kink& kink, double factor) {
  const double* T0 = instants_->basis(before(kink.now));
  const double* T1 = instants_->basis(kink.now);
  const double x = kink.share;
  const double by_slope = kink_moments(x)[0][0];
  const double of_begin = factor * (end_moment(x) * (1.0 - x) - by_slope);
  const double of_end = factor * (end_moment(x) * x + by_slope);
  for (std::size_t l = 0; l < n_rows_; ++l) moved_[l] = of_begin * T0[l] + of_end * T1[l];
}

/// Slip begins or ends; where it begins the part of a slider that the run left goes to `phase_`.
void LineDerivatives::add_slip(const Kink& kink, const LineColumns& columns) {
  const bool begins = kink.kind == Kink::Kind::slips;
  const double q = begins ? -point_.tangential_stiffness : point_.tangential_stiffness;
  const double width = point_.compliance() * point_.normal_stiffness;
  add_kink(kink, q, -q * kink.side * width, begins);
  if (!begins) return;
  at_kink(kink, q);
  if (kink.slider == Kink::Slider::run) {
    add(phase_, 1.0, moved_.data());
  } else if (kink.slider == Kink::Slider::landing) {
    add_anchor(smooth_landing(kink.now, point_.normal_stiffness, columns), moved_);
  } else {
    const std::size_t n = instants_->size();
    add_anchor({.first = (kink.now + n - 2) % n,
                .share = StepSpline::shares(kink.turn),
                .by_approach = kink.side * width},  // slipped the other way
               moved_);
  }
}

/// Contact opens or closes.
void LineDerivatives::add_contact(const Kink& kink) {
  const double k_v = point_.normal_stiffness;
  add_load_moments(kink, k_v, *instants_, normal_);
  if (point_.tangential_stiffness == 0.0) return;
  if (kink.side != 0.0) {
    const double sign = kink.kind == Kink::Kind::closes ? 1.0 : -1.0;
    add_kink(kink, 0.0, sign * kink.side * point_.friction_coefficient * k_v, true);
    return;
  }
  // It sticks from where r vanishes: dx = −dr/r'.
  add_kink(kink, point_.tangential_stiffness, 0.0, false);
  sum_around(kink.now, StepSpline::shares(kink.share));
  at_kink(kink, -ratio_of(kink.friction[0], kink.load[0]));
  add_outer(moved_, b_, 0.0, k_v);
}

std::size_t LineDerivatives::before(std::size_t now) const {
  return now > 0 ? now - 1 : instants_->size() - 1;
}

void LineDerivatives::any_surface(const std::vector<InstantSlopes>& slopes,
                                  double closeness_by_approach, double frequency,
                                  const std::vector<Run>& runs, const LineColumns& columns) {
  clear();
  const std::size_t n = instants_->size();
  const auto anchor_at = [&](std::size_t i) {
    const double side = columns.slider[i * block_size] < columns.u[i * block_size] ? 1.0 : -1.0;
    const InstantSlopes& at = slopes[i];
    const double along = at.rate < 0.0 ? -1.0 : 1.0;
    return Anchor{.first = i,
                  .by_approach = -side * at.width_by_approach,
                  .by_rate = -side * at.width_by_rate * frequency * along,
                  .by_frequency = -side * at.width_by_rate * std::abs(at.rate)};
  };
  for (const Run& run : runs) {
    if (run.state == InstantState::separated) continue;
    std::fill(phase_.begin(), phase_.end(), 0.0);
    for (std::size_t j = 0; j < run.length; ++j) {
      const std::size_t i = (run.begin + j) % n;
      const InstantSlopes& at = slopes[i];
      const double* moment = instants_->moment_basis(i);
      add(normal_, at.load_by_approach, moment);
      if (slips(run.state)) {
        const double sign = sign_of(run.state);
        add(limit_, sign * at.limit_by_approach, moment);
        if (at.limit_by_rate == 0.0) continue;
        const double along = at.rate < 0.0 ? -1.0 : 1.0;
        add(rate_, sign * at.limit_by_rate * frequency * along, moment);
        add(by_frequency_, sign * at.limit_by_rate * std::abs(at.rate), instants_->basis(i));
        continue;
      }
      const double spring = columns.u[i * block_size] - columns.slider[i * block_size];
      add(stick_, at.stiffness, moment);
      add(limit_, at.stiffness_by_approach * spring, moment);
      add(phase_, -at.stiffness, instants_->basis(i));
    }
    if (slips(run.state)) continue;
    const std::size_t before = (run.begin + n - 1) % n;
    if (run.length == n) {
      const std::size_t i = last_push(columns);
      if (i < n && columns.slider[0] != 0.0) add_anchor(anchor_at(i), phase_);
    } else if (columns.closeness[before * block_size] <= 0.0) {
      add_anchor(landing(before, run.begin, closeness_by_approach, columns), phase_);
    } else {
      add_anchor(anchor_at(before), phase_);
    }
  }
  sum_up(frequency);
}

void LineDerivatives::mend_load(const Kinks& kinks, double normal_stiffness) {
  for (const Kink& kink : kinks.all) add_load_moments(kink, normal_stiffness, *instants_, normal_);
}

}  // namespace microslip::contact::sampled
