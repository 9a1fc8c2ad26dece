#include "contact/sampled/plane_point.hpp"

#include <algorithm>
#include <cmath>

namespace microslip::contact::sampled {
namespace {

using Vector = std::array<double, 2>;

// Products of these are added up at a time: they stay in the nearest cache.
constexpr std::size_t most_waiting = 32;

std::size_t padded(std::size_t n) { return (n + 7) / 8 * 8; }

double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1]; }
Vector across(const Vector& e) { return {-e[1], e[0]}; }

void add(double* sum, double factor, const double* terms, std::size_t n) {
  for (std::size_t l = 0; l < n; ++l) sum[l] += factor * terms[l];
}

}  // namespace

void PlaneDerivatives::reset(const Instants& instants) {
  instants_ = &instants;
  const std::size_t rows = n_rows_ = instants.n_rows();
  n_columns_ = 3 * rows + 2;
  for (Row* row : {&angle_, &next_, &slider_[0], &slider_[1]}) row->assign(padded(n_columns_), 0.0);
  size_ = {2 * rows, n_columns_, padded(2 * rows), padded(n_columns_ + product_slack)};
  left_.resize(most_waiting * size_.phi_stride);
  right_.assign(most_waiting * size_.stride, 0.0);
  sum_.resize(2 * rows * size_.stride);
  for (std::size_t d = 0; d < 2; ++d) {
    stick_[d].resize(instants.n_moments());
    limit_[d].resize(instants.n_moments());
    for (Row& part : by_[d]) part.resize(rows * rows + product_slack);  // read on behind
    by_frequency_[d].resize(rows);
  }
  normal_.resize(instants.n_moments());
  product_row_.resize(rows);
  products_.reset(instants.n_harmonics());
}

Vector PlaneDerivatives::slider_before(std::size_t i) const {
  if (start_ != nullptr && i == 0) return start_->slider;
  return at(point_.arrays->slider_p, point_.arrays->slider_r, i);
}

Vector PlaneDerivatives::pull_before(std::size_t i) const {
  if (start_ != nullptr && i == 0) return start_->pull;
  return at(point_.arrays->pull_p, point_.arrays->pull_r, i);
}

/// x of touch-down, in parts of the step.
double PlaneDerivatives::share_apart(std::size_t before, std::size_t now) const {
  const double r0 = at(point_.arrays->closeness, before);
  return -r0 / (at(point_.arrays->closeness, now) - r0);
}

void PlaneDerivatives::add_position(Row& row, std::size_t i, double by_p, double by_r) const {
  const double* T = instants_->basis(i);
  add(row.data(), by_p, T, n_rows_);
  add(row.data() + 2 * n_rows_, by_r, T, n_rows_);
}

void PlaneDerivatives::add_width(Row& row, std::size_t i, double by_p, double by_r) const {
  const PlaneSlopes& s = slopes(i);
  const double by_approach = by_p * s.width_by_approach[0] + by_r * s.width_by_approach[1];
  add(row.data() + n_rows_, by_approach, instants_->basis(i), n_rows_);
  const double by_rate = by_p * s.width_by_rate[0] + by_r * s.width_by_rate[1];
  if (by_rate == 0.0) return;
  const double* rates = instants_->rates(i);
  add(row.data(), by_rate * s.rate_by_speed[0], rates, n_rows_);
  add(row.data() + 2 * n_rows_, by_rate * s.rate_by_speed[1], rates, n_rows_);
  row[3 * n_rows_ + 1] += by_rate * s.rate_by_frequency;
}

void PlaneDerivatives::add_share_apart(Row& row, std::size_t before, std::size_t now,
                                       double factor) const {
  const double share = share_apart(before, now);
  const double change = at(point_.arrays->closeness, now) - at(point_.arrays->closeness, before);
  const double by_approach = -factor * point_.closeness_by_approach / change;
  add(row.data() + n_rows_, (1.0 - share) * by_approach, instants_->basis(before), n_rows_);
  add(row.data() + n_rows_, share * by_approach, instants_->basis(now), n_rows_);
}

/// (2) after slip at i.
void PlaneDerivatives::leave_slip(std::size_t i) {
  const Vector e = pull_before(i);
  const Vector W = at(point_.arrays->width_p, point_.arrays->width_r, i);
  const Vector turn = {W[0] * e[1], -W[1] * e[0]};
  for (std::size_t d = 0; d < 2; ++d) {
    for (std::size_t l = 0; l < n_columns_; ++l) slider_[d][l] = turn[d] * angle_[l];
  }
  add_position(slider_[0], i, 1.0, 0.0);
  add_width(slider_[0], i, -e[0], 0.0);
  add_position(slider_[1], i, 0.0, 1.0);
  add_width(slider_[1], i, 0.0, -e[1]);
  memory_ = Memory::slider;
}

void PlaneDerivatives::land(std::size_t before, std::size_t now) {
  const PlaneArrays& a = *point_.arrays;
  const double share = share_apart(before, now);
  const Vector x0 = at(a.u, a.w, before);
  const Vector x1 = at(a.u, a.w, now);
  for (std::size_t d = 0; d < 2; ++d) {
    std::fill(slider_[d].begin(), slider_[d].end(), 0.0);
    const Vector unit = {d == 0 ? 1.0 : 0.0, d == 0 ? 0.0 : 1.0};
    add_position(slider_[d], before, (1.0 - share) * unit[0], (1.0 - share) * unit[1]);
    add_position(slider_[d], now, share * unit[0], share * unit[1]);
    add_share_apart(slider_[d], before, now, x1[d] - x0[d]);
  }
  memory_ = Memory::slider;
}

void PlaneDerivatives::go_on(std::size_t before, std::size_t now) {
  const double* g = point_.arrays->turns + now * n_turn_numbers * block_size + point_.place;
  const auto number = [&](TurnNumber k) { return g[k * block_size]; };
  const double kept = number(by_angle);
  for (std::size_t l = 0; l < n_columns_; ++l) angle_[l] *= kept;
  add_position(angle_, before, -number(by_way_p), -number(by_way_r));
  add_position(angle_, now, number(by_way_p), number(by_way_r));
  add_width(angle_, before, number(by_first_width_p), number(by_first_width_r));
  add_width(angle_, now, number(by_last_width_p), number(by_last_width_r));
}

/// The onset ξ: |η_ξ| = 1 with η_ξ = (1−ξ) η₀ + ξ η₁, and α₀ is the angle of η_ξ.
void PlaneDerivatives::begin_slip(std::size_t before, std::size_t now) {
  const PlaneArrays& a = *point_.arrays;
  const double* g = a.turns + now * n_turn_numbers * block_size + point_.place;
  const auto number = [&](std::size_t k) { return g[k * block_size]; };
  const double part = number(onset);
  const Vector s = slider_before(before);
  const Vector x0 = at(a.u, a.w, before);
  const Vector x1 = at(a.u, a.w, now);
  const Vector inverse_0 = at(a.inverse_p, a.inverse_r, before);
  const Vector inverse_1 = at(a.inverse_p, a.inverse_r, now);
  const Vector W0 = at(a.width_p, a.width_r, before);
  const Vector W1 = at(a.width_p, a.width_r, now);
  const Vector pull_0 = pull_before(before);
  const Vector pull_1 = {inverse_1[0] * (x1[0] - s[0]), inverse_1[1] * (x1[1] - s[1])};
  const Vector change = {pull_1[0] - pull_0[0], pull_1[1] - pull_0[1]};
  const Vector e = {pull_0[0] + part * change[0], pull_0[1] + part * change[1]};
  const Vector way = {x1[0] - x0[0], x1[1] - x0[1]};
  const Vector rise = {W1[0] - W0[0], W1[1] - W0[1]};
  const Vector by_way = {number(by_way_p), number(by_way_r)};
  const Vector by_first = {number(by_first_width_p), number(by_first_width_r)};
  const Vector by_last = {number(by_last_width_p), number(by_last_width_r)};
  const double approach = dot(e, change);
  const double by_part = dot(by_first, rise) - dot(by_way, way);
  const double aside = dot(across(e), change);
  std::fill(next_.begin(), next_.end(), 0.0);
  Vector by_x0{}, by_x1{}, by_w0{}, by_w1{};
  for (std::size_t d = 0; d < 2; ++d) {
    const double by_pull =
        number(by_angle) * (across(e)[d] - aside * e[d] / approach) - by_part * e[d] / approach;
    const double first = (1.0 - part) * by_pull * inverse_0[d];
    const double last = part * by_pull * inverse_1[d];
    by_x0[d] = first - (1.0 - part) * by_way[d];
    by_x1[d] = last + (1.0 - part) * by_way[d];
    by_w0[d] = -first * pull_0[d] + (1.0 - part) * by_first[d];
    by_w1[d] = -last * pull_1[d] + part * by_first[d] + by_last[d];
    add(next_.data(), -(first + last), slider_[d].data(), n_columns_);
  }
  add_position(next_, before, by_x0[0], by_x0[1]);
  add_position(next_, now, by_x1[0], by_x1[1]);
  add_width(next_, before, by_w0[0], by_w0[1]);
  add_width(next_, now, by_w1[0], by_w1[1]);
  std::swap(angle_, next_);
  memory_ = Memory::angle;
}

/// dα of (λ + W) e = b, |e| = 1, as functions of db and dW: settled_ · (db − e dW).
void PlaneDerivatives::settle(const Vector& b, std::size_t now) {
  const PlaneArrays& a = *point_.arrays;
  const Vector e = start_ != nullptr && now == 0 ? start_->pull : at(a.pull_p, a.pull_r, now);
  const Vector W = at(a.width_p, a.width_r, now);
  const double lambda = dot(e, b) - e[0] * e[0] * W[0] - e[1] * e[1] * W[1];
  const Vector inverse = {1.0 / (lambda + W[0]), 1.0 / (lambda + W[1])};
  const Vector aside = across(e);
  const double along = e[0] * e[0] * inverse[0] + e[1] * e[1] * inverse[1];
  const double cross = e[0] * e[1] * (inverse[1] - inverse[0]);
  std::fill(angle_.begin(), angle_.end(), 0.0);
  for (std::size_t d = 0; d < 2; ++d) {
    settled_[d] = inverse[d] * (aside[d] - cross / along * e[d]);
  }
  add_position(angle_, now, settled_[0], settled_[1]);
  add_width(angle_, now, -settled_[0] * e[0], -settled_[1] * e[1]);
  memory_ = Memory::angle;
}

void PlaneDerivatives::slip_from_landing(std::size_t before, std::size_t now) {
  const PlaneArrays& a = *point_.arrays;
  const double share = share_apart(before, now);
  const Vector x0 = at(a.u, a.w, before);
  const Vector x1 = at(a.u, a.w, now);
  const Vector way = {x1[0] - x0[0], x1[1] - x0[1]};
  settle({(1.0 - share) * way[0], (1.0 - share) * way[1]}, now);
  const double rest = 1.0 - share;
  add_position(angle_, now, (rest - 1.0) * settled_[0], (rest - 1.0) * settled_[1]);
  add_position(angle_, before, -rest * settled_[0], -rest * settled_[1]);
  add_share_apart(angle_, before, now, -dot(settled_, way));
}

/// The memory at i from that at the instant before.
void PlaneDerivatives::advance(std::size_t i, InstantState before) {
  const std::size_t then = i == 0 ? instants_->size() - 1 : i - 1;
  const InstantState now = state(i);
  if (now == InstantState::separated) {
    memory_ = Memory::none;
  } else if (now == InstantState::stick) {
    if (before == InstantState::separated) land(then, i);
    if (memory_ == Memory::angle) leave_slip(then);
  } else {
    switch (static_cast<SlipEntry>(static_cast<int>(at(point_.arrays->entry, i)))) {
      case SlipEntry::touches_down:
        slip_from_landing(then, i);
        break;
      case SlipEntry::goes_on:
        go_on(then, i);
        break;
      case SlipEntry::begins:
        if (memory_ == Memory::angle) leave_slip(then);
        begin_slip(then, i);
        break;
    }
  }
}

void PlaneDerivatives::begin_history(const Point& point, const PlaneStart& start) {
  point_ = point;
  start_ = &start;
  for (Row& row : slider_) std::fill(row.begin(), row.end(), 0.0);
  memory_ = Memory::slider;
  if (start.state == InstantState::slip) settle(at(point.arrays->u, point.arrays->w, 0), 0);
  start_ = nullptr;
}

/// n·ds = Σ_k c_k n_k·(dx_k − dW_k e_k) of both windows, with n of the whole window on the left.
void PlaneDerivatives::begin_corner(const Point& point, const PlaneCorner& corner) {
  point_ = point;
  start_ = nullptr;
  const Vector& a = corner.windows[0].normal;
  const Vector& b = corner.windows[1].normal;
  const double divisor = a[0] * b[1] - a[1] * b[0];
  const std::array<Vector, 2> by_excess = {Vector{b[1] / divisor, -a[1] / divisor},
                                           Vector{-b[0] / divisor, a[0] / divisor}};
  for (std::size_t d = 0; d < 2; ++d) {
    std::fill(slider_[d].begin(), slider_[d].end(), 0.0);
    for (std::size_t j = 0; j < 2; ++j) {
      for (const CornerInstant& now : corner.windows[j].instants) {
        const double part = by_excess[d][j] * now.share;
        const Vector by_x = {part * now.normal[0], part * now.normal[1]};
        add_position(slider_[d], now.instant, by_x[0], by_x[1]);
        add_width(slider_[d], now.instant, -by_x[0] * now.length * now.pull[0],
                  -by_x[1] * now.length * now.pull[1]);
      }
    }
  }
  memory_ = Memory::slider;
}

void PlaneDerivatives::carry_history(const Point& point, const PlaneStart& start) {
  point_ = point;
  start_ = &start;
  InstantState before = start.state;
  for (std::size_t i = 1; i <= instants_->size(); ++i) {
    const std::size_t now = i < instants_->size() ? i : 0;
    // Instant 0 is now the end of the period, but for the step that begins there.
    if (i == 2) start_ = nullptr;
    advance(now, before);
    before = state(now);
  }
  start_ = nullptr;
}

void PlaneDerivatives::clear() {
  std::fill(sum_.begin(), sum_.end(), 0.0);
  std::fill(normal_.begin(), normal_.end(), 0.0);
  for (std::size_t d = 0; d < 2; ++d) {
    std::fill(stick_[d].begin(), stick_[d].end(), 0.0);
    std::fill(limit_[d].begin(), limit_[d].end(), 0.0);
  }
  n_waiting_ = 0;
}

/// Where what multiplies the memory is to be written: f_p, then f_r.
double* PlaneDerivatives::push(const Row& memory) {
  if (n_waiting_ == most_waiting) flush();
  std::copy_n(memory.data(), n_columns_, right_.data() + n_waiting_ * size_.stride);
  return left_.data() + n_waiting_++ * size_.phi_stride;
}

void PlaneDerivatives::flush() {
  if (n_waiting_ == 0) return;
  product_kernels().product(size_, n_waiting_, left_.data(), right_.data(), sum_.data());
  n_waiting_ = 0;
}

void PlaneDerivatives::add_constant_stick(const Run& run) {
  const std::size_t n = instants_->size();
  const std::size_t moments = instants_->n_moments();
  const std::size_t H = n_rows_ / 2;
  const std::size_t end = run.begin + run.length;
  const double* high = instants_->sums(std::min(end, n));
  const double* low = instants_->sums(run.begin);
  const double* over = instants_->sums(end > n ? end - n : 0);
  const auto sum = [&](std::size_t m) { return high[m] - low[m] + over[m]; };
  const PlaneSlopes& k = slopes(0);
  for (std::size_t m = 0; m < moments; ++m) {
    const double value = sum(m);
    normal_[m] += k.load_by_approach * value;
    stick_[0][m] += k.stiffness[0] * value;
    stick_[1][m] += k.stiffness[1] * value;
  }
  for (std::size_t d = 0; d < 2; ++d) {
    double* left = push(slider_[d]);
    std::fill_n(left, 2 * n_rows_, 0.0);
    left += d * n_rows_;
    left[0] = -k.stiffness[d] * sum(0);
    for (std::size_t h = 1; h <= H; ++h) {
      left[h] = -k.stiffness[d] * sum(2 * H + h);
      left[H + h] = -k.stiffness[d] * sum(h);
    }
  }
}

void PlaneDerivatives::add_stick(const Run& run) {
  const PlaneArrays& a = *point_.arrays;
  std::array<double*, 2> left{};
  if (n_waiting_ + 2 > most_waiting) flush();  // both are filled below
  for (std::size_t d = 0; d < 2; ++d) {
    left[d] = push(slider_[d]);
    std::fill_n(left[d], 2 * n_rows_, 0.0);
    left[d] += d * n_rows_;
  }
  for (std::size_t j = 0; j < run.length; ++j) {
    const std::size_t i = (run.begin + j) % instants_->size();
    const PlaneSlopes& k = slopes(i);
    const double* moment = instants_->moment_basis(i);
    add(normal_.data(), k.load_by_approach, moment, normal_.size());
    const Vector x = at(a.u, a.w, i);
    const Vector s = at(a.slider_p, a.slider_r, i);
    for (std::size_t d = 0; d < 2; ++d) {
      add(left[d], -k.stiffness[d], instants_->basis(i), n_rows_);
      add(stick_[d].data(), k.stiffness[d], moment, normal_.size());
      add(limit_[d].data(), k.stiffness_by_approach[d] * (x[d] - s[d]), moment, normal_.size());
    }
  }
}

void PlaneDerivatives::add_slip(std::size_t i) {
  const PlaneArrays& a = *point_.arrays;
  const PlaneSlopes& k = slopes(i);
  const double limit = point_.constant ? k.stiffness[0] > 0.0 ? k.stiffness[0] * at(a.width_p, i)
                                                              : k.stiffness[1] * at(a.width_r, i)
                                       : k.limit;
  const Vector e = at(a.pull_p, a.pull_r, i);
  const double* T = instants_->basis(i);
  const double* moment = instants_->moment_basis(i);
  add(normal_.data(), k.load_by_approach, moment, normal_.size());
  for (std::size_t d = 0; d < 2; ++d) {
    add(limit_[d].data(), e[d] * k.limit_by_approach, moment, normal_.size());
  }
  double* left = push(angle_);
  for (std::size_t l = 0; l < n_rows_; ++l) left[l] = -limit * e[1] * T[l];
  for (std::size_t l = 0; l < n_rows_; ++l) left[n_rows_ + l] = limit * e[0] * T[l];
  if (k.limit_by_rate == 0.0) return;
  std::fill(next_.begin(), next_.end(), 0.0);
  const double* rates = instants_->rates(i);
  add(next_.data(), k.limit_by_rate * k.rate_by_speed[0], rates, n_rows_);
  add(next_.data() + 2 * n_rows_, k.limit_by_rate * k.rate_by_speed[1], rates, n_rows_);
  next_[3 * n_rows_ + 1] = k.limit_by_rate * k.rate_by_frequency;
  left = push(next_);
  for (std::size_t l = 0; l < n_rows_; ++l) left[l] = e[0] * T[l];
  for (std::size_t l = 0; l < n_rows_; ++l) left[n_rows_ + l] = e[1] * T[l];
}

/// All runs, from the memory at the instant before them.
void PlaneDerivatives::walk(const std::vector<Run>& runs, InstantState before) {
  const std::size_t n = instants_->size();
  for (const Run& run : runs) {
    if (run.state == InstantState::separated) {
      memory_ = Memory::none;
    } else if (run.state == InstantState::stick) {
      if (before != InstantState::stick) advance(run.begin, before);
      start_ = nullptr;
      if (point_.constant) {
        add_constant_stick(run);
      } else {
        add_stick(run);
      }
    } else {
      for (std::size_t j = 0; j < run.length; ++j) {
        const std::size_t i = (run.begin + j) % n;
        advance(i, before);
        start_ = nullptr;
        add_slip(i);
        before = run.state;
      }
    }
    before = run.state;
  }
  flush();
}

/// dα₀ = D + M dα₀, into the sums.
void PlaneDerivatives::close() {
  const std::size_t own = 3 * n_rows_;
  // As good as at rest: what is left to move it is rounding.
  constexpr double least = 1e-11;
  const double rest = 1.0 - angle_[own];
  if (std::abs(rest) < least) return;
  for (std::size_t k = 0; k < 2 * n_rows_; ++k) {
    double* row = sum_.data() + k * size_.stride;
    const double factor = row[own] / rest;
    add(row, factor, angle_.data(), own);
    row[own + 1] += factor * angle_[own + 1];
  }
}

void PlaneDerivatives::collect() {
  for (std::size_t d = 0; d < 2; ++d) {
    for (std::size_t k = 0; k < n_rows_; ++k) {
      const double* row = sum_.data() + (d * n_rows_ + k) * size_.stride;
      for (std::size_t s = 0; s < 3; ++s) {
        std::copy_n(row + s * n_rows_, n_rows_, by_[d][s].data() + k * n_rows_);
      }
      by_frequency_[d][k] = row[3 * n_rows_ + 1];
    }
    const auto add_products = [&](const Row& moments, Row& to) {
      products_.set(moments.data());
      for (std::size_t k = 0; k < n_rows_; ++k) {
        products_.row(k, product_row_.data());
        add(to.data() + k * n_rows_, 1.0, product_row_.data(), n_rows_);
      }
    };
    add_products(stick_[d], by_[d][2 * d]);
    add_products(limit_[d], by_[d][1]);
  }
}

void PlaneDerivatives::after_history(const Point& point, const PlaneStart& start,
                                     const std::vector<Run>& runs) {
  const std::size_t n = instants_->size();
  point_ = point;
  start_ = &start;
  clear();
  // From instant 1 to instant n, which is 0.
  std::vector<Run> order;
  std::vector<Run> rest;
  for (const Run& run : runs) {
    const std::size_t end = run.begin + run.length;
    if (run.begin == 0) {
      rest.push_back({run.state, 0, 1});
      if (run.length > 1) order.push_back({run.state, 1, run.length - 1});
    } else if (end > n) {
      order.push_back({run.state, run.begin, n + 1 - run.begin});
      if (end > n + 1) order.push_back({run.state, 1, end - n - 1});
    } else {
      order.push_back(run);
    }
  }
  std::ranges::sort(order, {}, &Run::begin);
  order.insert(order.end(), rest.begin(), rest.end());
  walk(order, start.state);
  collect();
}

void PlaneDerivatives::steady(const Point& point, const std::vector<Run>& runs) {
  point_ = point;
  start_ = nullptr;
  clear();
  // The run to end with: what is known there does not depend on what was before, or on one number.
  std::size_t last = 0;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (runs[i].state == InstantState::slip && runs[last].state == InstantState::stick) last = i;
    if (runs[i].state == InstantState::separated) last = i;
  }
  std::vector<Run> order = runs;
  std::rotate(order.begin(), order.begin() + static_cast<std::ptrdiff_t>((last + 1) % runs.size()),
              order.end());
  const bool slips = order.back().state == InstantState::slip;
  memory_ = slips ? Memory::angle : Memory::none;
  std::fill(angle_.begin(), angle_.end(), 0.0);
  angle_[3 * n_rows_] = 1.0;
  walk(order, order.back().state);
  if (slips) close();
  collect();
}

void PlaneDerivatives::mend_load(const Kinks& kinks, double normal_stiffness) {
  for (const Kink& kink : kinks.all) add_load_moments(kink, normal_stiffness, *instants_, normal_);
}

}  // namespace microslip::contact::sampled
