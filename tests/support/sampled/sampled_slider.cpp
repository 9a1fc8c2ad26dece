#include "tests/support/sampled/sampled_slider.hpp"

#include <cmath>

namespace microslip::contact {
namespace {

using Kind = SliderMemory::Kind;

double sign_of(double x) { return x > 0.0 ? 1.0 : (x < 0.0 ? -1.0 : 0.0); }

}  // namespace

void set_basis_rate(const double* basis, int n_harmonics, Eigen::VectorXd& rate) {
  rate.resize(2 * n_harmonics + 1);
  rate[0] = 0.0;
  for (Eigen::Index h = 1; h <= n_harmonics; ++h) {
    rate[2 * h - 1] = static_cast<double>(h) * basis[2 * h];
    rate[2 * h] = -static_cast<double>(h) * basis[2 * h - 1];
  }
}

SliderSample clipped(SliderSample now, const ContactSample& band, SliderMemory positive,
                     SliderMemory negative) {
  const double low = band.u - band.half_width;
  const double high = band.u + band.half_width;
  now.state = ContactState::stick;
  if (now.slider < low) {
    return {ContactState::positive_slip, low, positive};
  }
  if (now.slider > high) {
    return {ContactState::negative_slip, high, negative};
  }
  return now;
}

SliderSample SampledSlider::step(SliderSample now, int j) const {
  const ContactSample& after = (*motion_)[j];
  if (after.is_open()) {
    return {ContactState::separated, after.u, {Kind::separated, j}};
  }
  const ContactSample& before = (*motion_)[motion_->before(j)];
  if (before.is_open()) {
    const double x = motion_->touch_share(j);
    now.slider = before.u + x * (after.u - before.u);
    now.memory = {Kind::touch_down, j};
  } else if (const ContactSample* turn = motion_->turn(j)) {
    now = clipped(now, *turn, {Kind::positive_turn, j}, {Kind::negative_turn, j});
  }
  return clipped(now, after, {Kind::positive_slip, j}, {Kind::negative_slip, j});
}

void SampledSlider::pass() {
  SliderSample now = samples_.back();
  for (int j = 0; j < motion_->size(); ++j) {
    now = step(now, j);
    samples_[static_cast<std::size_t>(j)] = now;
  }
}

void SampledSlider::march(const SampledMotion& motion) {
  motion_ = &motion;
  samples_.resize(static_cast<std::size_t>(motion.size()));
  samples_.back() = {};  // virgin: s = 0
  pass();
  pass();
}

CycleRegime SampledSlider::regime() const {
  bool opens = false;
  bool touches = false;
  bool slips = false;
  for (const SliderSample& now : samples_) {
    opens = opens || now.state == ContactState::separated;
    touches = touches || now.state != ContactState::separated;
    slips = slips || now.state == ContactState::positive_slip ||
            now.state == ContactState::negative_slip;
  }
  if (!touches) {
    return CycleRegime::separated;
  }
  if (opens) {
    return CycleRegime::separation;
  }
  return slips ? CycleRegime::stick_slip : CycleRegime::full_stick;
}

void SampledSlider::differentiate(const SliderMemory& memory, const SampleGrid& grid,
                                  int n_harmonics, SliderDerivative& result) const {
  result.by_u.setZero(2 * n_harmonics + 1);
  result.by_v.setZero(2 * n_harmonics + 1);
  result.by_frequency = 0.0;
  switch (memory.kind) {
    case Kind::virgin:
      return;
    case Kind::positive_slip:
      return differentiate_clip(1.0, memory.step, grid, n_harmonics, result);
    case Kind::negative_slip:
      return differentiate_clip(-1.0, memory.step, grid, n_harmonics, result);
    case Kind::separated:
      result.by_u = grid.basis.col(memory.step).head(result.by_u.size());
      return;
    case Kind::touch_down:
      return differentiate_touch(memory.step, grid, result);
    case Kind::positive_turn:
      return differentiate_turn(1.0, memory.step, grid, n_harmonics, result);
    case Kind::negative_turn:
      return differentiate_turn(-1.0, memory.step, grid, n_harmonics, result);
  }
}

// s = u − sign g.
void SampledSlider::differentiate_clip(double sign, int j, const SampleGrid& grid, int n_harmonics,
                                       SliderDerivative& result) const {
  const ContactSample& at = (*motion_)[j];
  const auto b = grid.basis.col(j).head(result.by_u.size());
  result.by_u = b;
  result.by_v = -sign * at.half_width_by_v * b;
  if (at.half_width_by_rate == 0.0) {
    return;
  }
  Eigen::VectorXd rate;
  set_basis_rate(grid.basis.col(j).data(), n_harmonics, rate);
  result.by_u -= sign * at.half_width_by_rate * motion_->frequency() * sign_of(at.u_rate) * rate;
  result.by_frequency = -sign * at.half_width_by_rate * std::abs(at.u_rate);
}

// s of (2): dx = −[(1 − x) dv_{j−1} + x dv_j]/(v_j − v_{j−1}).
void SampledSlider::differentiate_touch(int j, const SampleGrid& grid,
                                        SliderDerivative& result) const {
  const int i = motion_->before(j);
  const ContactSample& a = (*motion_)[i];
  const ContactSample& c = (*motion_)[j];
  const double x = motion_->touch_share(j);
  const Eigen::Index n = result.by_u.size();
  result.by_u = (1.0 - x) * grid.basis.col(i).head(n) + x * grid.basis.col(j).head(n);
  if (x > 0.0 && x < 1.0) {
    result.by_v = -((c.u - a.u) / (c.v - a.v)) * result.by_u;
  }
}

// s = u_x − sign g(v_x) with u_x, v_x, x of sampled_motion.hpp.
void SampledSlider::differentiate_turn(double sign, int j, const SampleGrid& grid, int n_harmonics,
                                       SliderDerivative& result) const {
  const int i = motion_->before(j);
  const ContactSample& a = (*motion_)[i];
  const ContactSample& c = (*motion_)[j];
  const double x = motion_->turn_share(j);
  const Eigen::Index n = result.by_u.size();
  Eigen::VectorXd rate_a;
  Eigen::VectorXd rate_c;
  set_basis_rate(grid.basis.col(i).data(), n_harmonics, rate_a);
  set_basis_rate(grid.basis.col(j).data(), n_harmonics, rate_c);
  const Eigen::VectorXd dx = ((1.0 - x) * rate_a + x * rate_c) / (a.u_rate - c.u_rate);
  const double by_v = -sign * motion_->turn(j)->half_width_by_v;
  result.by_u = grid.basis.col(i).head(n) + 0.5 * motion_->step() * (a.u_rate * dx + x * rate_a) +
                by_v * (c.v - a.v) * dx;
  result.by_v = by_v * ((1.0 - x) * grid.basis.col(i).head(n) + x * grid.basis.col(j).head(n));
}

}  // namespace microslip::contact
