#include "contact/sampled/line_point.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace microslip::contact::sampled {
namespace {

void add(std::vector<double>& sum, double factor, const double* terms) {
  for (std::size_t m = 0; m < sum.size(); ++m) sum[m] += factor * terms[m];
}

double sign_of(InstantState state) { return state == InstantState::negative_slip ? -1.0 : 1.0; }

bool slips(InstantState state) {
  return state != InstantState::stick && state != InstantState::separated;
}

}  // namespace

void find_runs(const double* state, std::size_t n, std::size_t stride, std::vector<Run>& runs) {
  runs.clear();
  std::size_t first = 1;
  while (first < n && state[first * stride] == state[(first - 1) * stride]) ++first;
  if (first == n) {  // at most one change, and that at 0
    runs.push_back({instant_state(state[0]), 0, n});
    return;
  }
  for (std::size_t j = 0; j < n; ++j) {
    const std::size_t i = first + j < n ? first + j : first + j - n;
    const InstantState now = instant_state(state[i * stride]);
    if (runs.empty() || runs.back().state != now) runs.push_back({now, i, 0});
    ++runs.back().length;
  }
}

CycleStates cycle_states(const std::vector<Run>& runs, std::size_t n) {
  const double step = 2.0 * std::numbers::pi / static_cast<double>(n);
  CycleStates result{CycleRegime::full_stick, PeriodStates(ContactState::stick)};
  bool any_slip = false;
  bool any_apart = false;
  for (const Run& run : runs) {
    any_slip = any_slip || slips(run.state);
    any_apart = any_apart || run.state == InstantState::separated;
    result.period.set(static_cast<ContactState>(run.state),
                      (static_cast<double>(run.begin) - 0.5) * step,
                      static_cast<double>(run.length) * step);
  }
  if (any_slip) result.regime = CycleRegime::stick_slip;
  if (any_apart) result.regime = CycleRegime::separation;
  if (any_apart && runs.size() == 1) result.regime = CycleRegime::separated;
  return result;
}

std::vector<CycleSegment> cycle_segments(const std::vector<Run>& runs, std::size_t n) {
  const double step = 2.0 * std::numbers::pi / static_cast<double>(n);
  std::vector<CycleSegment> phases;
  phases.reserve(runs.size());
  for (const Run& run : runs) {
    phases.push_back({static_cast<ContactState>(run.state),
                      (static_cast<double>(run.begin) - 0.5) * step,
                      static_cast<double>(run.length) * step, 0.0});
  }
  return joined_segments(phases, 0.0);
}

/// ds of (2) as functions of û and v̂: (1−x) T(before) + x T(now) and what follows from it.
struct LineDerivatives::Anchor {
  std::size_t before = 0;
  std::size_t now = 0;
  double share = 1.0;  // x
  double by_approach = 0.0;
  double by_rate = 0.0;
  double by_frequency = 0.0;
};

void LineDerivatives::reset(const Instants& instants) {
  instants_ = &instants;
  n_rows_ = instants.n_rows();
  by_u_.resize(n_rows_ * n_rows_ + pack_size);  // products read on behind the last row
  by_v_.resize(n_rows_ * n_rows_ + pack_size);
  by_frequency_.resize(n_rows_);
  for (auto* moments : {&stick_, &limit_, &rate_, &normal_, &part_}) {
    moments->resize(instants.n_moments());
  }
  for (auto* row : {&phase_, &b_u_, &b_v_, &row_}) row->resize(n_rows_);
  products_.reset(instants.n_harmonics());
}

void LineDerivatives::clear() {
  for (auto* sum : {&by_u_, &by_v_, &by_frequency_, &stick_, &limit_, &rate_, &normal_}) {
    std::fill(sum->begin(), sum->end(), 0.0);
  }
}

void LineDerivatives::add_anchor(const Anchor& anchor, const std::vector<double>& a) {
  const double* before = instants_->basis(anchor.before);
  const double* now = instants_->basis(anchor.now);
  const double* rates = instants_->rates(anchor.now);
  for (std::size_t l = 0; l < n_rows_; ++l) {
    const double T = (1.0 - anchor.share) * before[l] + anchor.share * now[l];
    b_u_[l] = T + anchor.by_rate * rates[l];
    b_v_[l] = anchor.by_approach * T;
  }
  for (std::size_t k = 0; k < n_rows_; ++k) {
    double* row_u = by_u_.data() + k * n_rows_;
    double* row_v = by_v_.data() + k * n_rows_;
    for (std::size_t l = 0; l < n_rows_; ++l) row_u[l] += a[k] * b_u_[l];
    for (std::size_t l = 0; l < n_rows_; ++l) row_v[l] += a[k] * b_v_[l];
    by_frequency_[k] += a[k] * anchor.by_frequency;
  }
}

LineDerivatives::Anchor LineDerivatives::landing(std::size_t before, std::size_t now,
                                                 double closeness_by_approach,
                                                 const LineColumns& columns) const {
  const double r0 = columns.closeness[before * block_size];
  const double change = columns.closeness[now * block_size] - r0;
  const double way = columns.u[now * block_size] - columns.u[before * block_size];
  return {before, now, -r0 / change, -way * closeness_by_approach / change, 0.0, 0.0};
}

/// Where a point that sticks throughout had its slider pushed to where it is; n: nowhere.
std::size_t LineDerivatives::last_push(const LineColumns& columns) const {
  const std::size_t n = instants_->size();
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t at = i * block_size;
    const double s = columns.slider[at];
    const double u = columns.u[at];
    const double g = columns.half_width[at];
    if (s == u - g || s == u + g) return i;
  }
  return n;
}

void LineDerivatives::add_weights(double frequency) {
  products_.set(stick_.data());
  for (std::size_t k = 0; k < n_rows_; ++k) {
    products_.row(k, row_.data());
    for (std::size_t l = 0; l < n_rows_; ++l) by_u_[k * n_rows_ + l] += row_[l];
  }
  products_.set(limit_.data());
  for (std::size_t k = 0; k < n_rows_; ++k) {
    products_.row(k, row_.data());
    for (std::size_t l = 0; l < n_rows_; ++l) by_v_[k * n_rows_ + l] += row_[l];
  }
  if (frequency == 0.0) return;
  // (sin bθ)' = b cos bθ and so on.
  const std::size_t H = n_rows_ / 2;
  products_.set(rate_.data());
  for (std::size_t k = 0; k < n_rows_; ++k) {
    products_.row(k, row_.data());
    double* to = by_u_.data() + k * n_rows_;
    for (std::size_t b = 1; b <= H; ++b) {
      to[b] += static_cast<double>(b) * row_[H + b];
      to[H + b] -= static_cast<double>(b) * row_[b];
    }
  }
}

void LineDerivatives::smooth(const SmoothPoint& point, const std::vector<Run>& runs,
                             const LineColumns& columns) {
  clear();
  const std::size_t n = instants_->size();
  const std::size_t H = n_rows_ / 2;
  const double k_u = point.tangential_stiffness;
  const double k_v = point.normal_stiffness;
  const double width_by_approach = k_u > 0.0 ? point.friction_coefficient * k_v / k_u : 0.0;
  for (const Run& run : runs) {
    if (run.state == InstantState::separated) continue;
    const std::size_t end = run.begin + run.length;
    std::fill(part_.begin(), part_.end(), 0.0);
    add(part_, 1.0, instants_->sums(std::min(end, n)));
    add(part_, -1.0, instants_->sums(run.begin));
    if (end > n) add(part_, 1.0, instants_->sums(end - n));
    add(normal_, k_v, part_.data());
    if (slips(run.state)) {
      add(limit_, sign_of(run.state) * point.friction_coefficient * k_v, part_.data());
      continue;
    }
    add(stick_, k_u, part_.data());
    phase_[0] = -k_u * part_[0];
    for (std::size_t h = 1; h <= H; ++h) {
      phase_[h] = -k_u * part_[2 * H + h];
      phase_[H + h] = -k_u * part_[h];
    }
    if (k_u == 0.0) continue;
    const std::size_t before = (run.begin + n - 1) % n;
    if (run.length == n) {
      const std::size_t i = last_push(columns);
      if (i == n || columns.slider[0] == 0.0) continue;
      const double side = columns.slider[0] < columns.u[i * block_size] ? 1.0 : -1.0;
      add_anchor({i, i, 1.0, -side * width_by_approach, 0.0, 0.0}, phase_);
    } else if (columns.closeness[before * block_size] <= 0.0) {
      add_anchor(landing(before, run.begin, k_v, columns), phase_);
    } else {
      const double side =
          columns.slider[before * block_size] < columns.u[before * block_size] ? 1.0 : -1.0;
      add_anchor({before, before, 1.0, -side * width_by_approach, 0.0, 0.0}, phase_);
    }
  }
  add_weights(0.0);
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
    return Anchor{i,
                  i,
                  1.0,
                  -side * at.width_by_approach,
                  -side * at.width_by_rate * frequency * along,
                  -side * at.width_by_rate * std::abs(at.rate)};
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
  add_weights(frequency);
}

}  // namespace microslip::contact::sampled
