#include "contact/line/slider_band.hpp"

#include <algorithm>
#include <cmath>

#include "contact/phase.hpp"
#include "contact/trigonometric_basis.hpp"

namespace microslip::contact {
namespace {

/// Σ h (|y_sh| + |y_ch|).
double rate_bound(const Eigen::VectorXd& y) {
  double sum = 0.0;
  for (Eigen::Index k = 1; k < y.size(); ++k) {
    const Eigen::Index h = (k + 1) / 2;
    sum += static_cast<double>(h) * std::abs(y[k]);
  }
  return sum;
}

void by_phase(std::vector<BandNode>& nodes) {
  std::sort(nodes.begin(), nodes.end(), [](const BandNode& a, const BandNode& b) {
    return a.phase < b.phase || (a.phase == b.phase && a.place.offset < b.place.offset);
  });
}

}  // namespace

BandStretch stretch_between(const BandNode& from, const BandNode& to) {
  const bool by_first = std::abs(from.place.offset) <= std::abs(to.place.offset);
  const BandAnchor& anchor = by_first ? from.place.anchor : to.place.anchor;
  const auto offset = [&anchor](const BandNode& node) {
    const bool same = node.place.anchor.phase == anchor.phase;
    return same ? node.place.offset : node.phase - anchor.phase;
  };
  return {anchor, offset(from), offset(to)};
}

void SliderBand::set(const SurfaceLaw& law, const Harmonics& motion, double frequency) {
  law_ = &law;
  frequency_ = frequency;
  position_mean_ = motion.mean()[0];
  u_ = motion.rows().col(0);
  v_ = motion.rows().col(1);
  u_[0] = 0.0;
  u_rate_.setZero(u_.size());
  u_second_.setZero(u_.size());
  v_rate_.setZero(v_.size());
  for (Eigen::Index h = 1; 2 * h < u_.size(); ++h) {
    const auto order = static_cast<double>(h);
    u_rate_[2 * h - 1] = -order * u_[2 * h];
    u_rate_[2 * h] = order * u_[2 * h - 1];
    v_rate_[2 * h - 1] = -order * v_[2 * h];
    v_rate_[2 * h] = order * v_[2 * h - 1];
    u_second_[2 * h - 1] = -order * order * u_[2 * h - 1];
    u_second_[2 * h] = -order * order * u_[2 * h];
  }
  const double fastest = frequency * rate_bound(u_);
  const double mu = std::max(law.friction().at_rest(), law.friction().at(fastest).value);
  const double closest = v_[0] + v_.tail(v_.size() - 1).cwiseAbs().sum();
  load_size_ = law.at(closest, 0.0).load;
  friction_size_ = law.first_stiffness() * u_.cwiseAbs().sum() + mu * load_size_;
  size_ = rate_bound(u_);
  if (has_spring()) {
    size_ += mu * law.point().normal_stiffness / law.first_stiffness() * rate_bound(v_);
  }
}

void SliderBand::set_motion(double phase, BandInstant& now) {
  trigonometric_basis(n_harmonics(), phase, basis_);
  const auto& basis = basis_;
  now.phase = phase;
  now.position = u_.dot(basis);
  now.velocity = u_rate_.dot(basis);
  now.approach = v_.dot(basis);
  now.approach_rate = v_rate_.dot(basis);
  if (law_->is_rate_dependent()) now.acceleration = u_second_.dot(basis);
}

void SliderBand::set_band(double speed, BandInstant& now) {
  now.surface = law_->at(now.approach, frequency_ * speed);
  if (!has_spring()) return;
  const SurfaceState& y = now.surface;
  const double mu = y.friction_coefficient / law_->first_stiffness();
  now.reach = mu * y.load_per_ratio;
  now.reach_by_approach = mu * y.load_per_ratio_by_approach;
  now.reach_rate = now.reach_by_approach * now.approach_rate;
  if (!law_->is_rate_dependent()) return;
  now.reach_by_rate = y.friction_coefficient_by_rate * y.load_per_ratio / law_->first_stiffness();
}

BandInstant SliderBand::at(const BandPlace& place) {
  BandInstant now;
  set_motion(place.phase(), now);
  if (layers_.is_near(place)) now.velocity = layers_.velocity(place);
  set_band(std::abs(now.velocity), now);
  if (law_->is_rate_dependent()) {
    now.reach_rate +=
        now.reach_by_rate * frequency_ * std::copysign(1.0, now.velocity) * now.acceleration;
  }
  return now;
}

void SliderBand::set_surface(BandInstants& now) const {
  const auto& motion = now.motion;
  if (!law_->is_smooth()) {
    for (std::size_t i = 0; i < n_band_nodes; ++i) {
      const SurfaceState y =
          law_->at(motion.approach[i], frequency_ * std::abs(motion.velocity[i]));
      now.friction_coefficient[i] = y.friction_coefficient;
      now.friction_coefficient_by_rate[i] = y.friction_coefficient_by_rate;
      now.load[i] = y.load;
      now.load_by_approach[i] = y.load_by_approach;
      now.stiffness_ratio[i] = y.stiffness_ratio;
      now.stiffness_ratio_by_approach[i] = y.stiffness_ratio_by_approach;
      now.reach[i] = y.load_per_ratio;
      now.reach_by_approach[i] = y.load_per_ratio_by_approach;
    }
    return;
  }
  const PointParameters& point = law_->point();
  for (std::size_t i = 0; i < n_band_nodes; ++i) {
    const FrictionCoefficient mu = law_->friction().at(frequency_ * std::abs(motion.velocity[i]));
    now.friction_coefficient[i] = mu.value;
    now.friction_coefficient_by_rate[i] = mu.by_rate;
  }
  for (std::size_t i = 0; i < n_band_nodes; ++i) {
    const double load = point.rest_load + point.normal_stiffness * motion.approach[i];
    now.load[i] = now.reach[i] = std::max(load, 0.0);
    now.load_by_approach[i] = now.reach_by_approach[i] = load > 0.0 ? point.normal_stiffness : 0.0;
  }
  now.stiffness_ratio.fill(1.0);
  now.stiffness_ratio_by_approach.fill(0.0);
}

/// From what set_surface() leaves in the reach: load per ratio of stiffness.
void SliderBand::set_band(BandInstants& now) const {
  const double spring = has_spring() ? 1.0 / law_->first_stiffness() : 0.0;
  const auto& motion = now.motion;
  for (std::size_t i = 0; i < n_band_nodes; ++i) {
    const double mu = now.friction_coefficient[i] * spring;
    now.reach_by_rate[i] = now.friction_coefficient_by_rate[i] * spring * now.reach[i];
    now.reach[i] *= mu;
    now.reach_by_approach[i] *= mu;
    const double sign = std::copysign(1.0, motion.velocity[i]);
    now.reach_rate[i] = now.reach_by_approach[i] * motion.approach_rate[i] +
                        now.reach_by_rate[i] * frequency_ * sign * motion.acceleration[i];
  }
}

void SliderBand::at(const BandPlaces& places, int n_basis, double* basis, BandInstants& now) {
  BandValues arcs;
  BandValues offsets;
  for (std::size_t i = 0; i < n_band_nodes; ++i) {
    arcs[i] = places.half * (*places.shares)[i];
    offsets[i] = places.middle + arcs[i];
  }
  const double middle = places.anchor.phase + places.middle;
  band_kernels().motion({u_.data(), v_.data(), n_harmonics()}, {std::sin(middle), std::cos(middle)},
                        arcs.data(), n_basis, basis, now.motion);
  layers_.correct(places.anchor, offsets, now.motion.velocity);
  set_surface(now);
  set_band(now);
}

BandInstant SliderBand::at_turn(double phase) {
  BandInstant now;
  set_motion(phase, now);
  set_band(0.0, now);
  return now;
}

BandNode SliderBand::edge_at(double phase, bool touches) {
  const BandPlace place = layers_.place(phase);
  const BandInstant now = at(place);
  // The load at a touch-down is rounding.
  if (touches) return {phase, now.position, now.position, true, false, place};
  return {phase, now.lower(), now.upper(), true, false, place};
}

void SliderBand::find_edges() {
  edges_.clear();
  contact_.clear();
  const auto set = [this](const Eigen::VectorXd& y) {
    polynomial_.reset(n_harmonics());
    polynomial_.set_mean(y[0]);
    for (int h = 1; h <= n_harmonics(); ++h) polynomial_.set(h, y[2 * h - 1], y[2 * h]);
  };
  const std::vector<double> kinks = law_->kinks();
  set(v_);
  for (std::size_t i = 0; i < kinks.size(); ++i) {
    polynomial_.set_mean(v_[0] - kinks[i]);
    find_sign_changes(polynomial_, changes_);
    if (i == 0) contact_ = changes_;
    for (const SignChange& change : changes_) {
      if (i > 0) edges_.push_back(change.phase);
    }
  }
  layers_.set(u_, law_->friction(), frequency_);
}

const std::vector<ContactRun>& SliderBand::find_runs() {
  runs_.clear();
  find_edges();
  if (contact_.empty()) {
    // The sign of the load is that of its mean; one without kinks never changes it.
    const std::vector<double> kinks = law_->kinks();
    const bool closed = kinks.empty() ? load_size_ > 0.0 : v_[0] > kinks[0];
    if (closed) add_run(0.0, two_pi, false);
    return runs_;
  }
  for (std::size_t i = 0; i < contact_.size(); ++i) {
    if (!contact_[i].rising) continue;
    const bool wraps = i + 1 == contact_.size();
    const double end = wraps ? contact_.front().phase + two_pi : contact_[i + 1].phase;
    add_run(contact_[i].phase, end, true);
  }
  return runs_;
}

/// All nodes inside (begin, end) that are known beforehand, counted on around the period.
std::vector<BandNode> SliderBand::inner_edges(double begin, double end) {
  std::vector<BandNode> nodes;
  const auto add = [&](double phase, const BandPlace& place, bool edge, bool turns) {
    for (const double turn : {-two_pi, 0.0, two_pi}) {
      const double at = phase + turn;
      if (!(at > begin && at < end)) continue;
      BandNode node{at, 0.0, 0.0, edge, turns, place};
      if (place.anchor.layered) node.place.anchor.phase += turn;
      nodes.push_back(node);
    }
  };
  for (const double phase : edges_) add(phase, layers_.place(phase), true, false);
  for (const double phase : layers_.stands()) add(phase, layers_.place(phase), true, true);
  for (const BandPlace& place : layers_.stops()) add(place.phase(), place, false, false);
  for (BandNode& node : nodes) {
    if (!node.place.anchor.layered) node.place.offset = node.phase;
    const BandInstant now = node.turns ? at_turn(node.phase) : at(node.place);
    node.lower = now.lower();
    node.upper = now.upper();
  }
  by_phase(nodes);
  return nodes;
}

void SliderBand::add_run(double begin, double end, bool touches_down) {
  ContactRun run;
  run.touches_down = touches_down;
  std::vector<BandNode> edges{edge_at(begin, touches_down)};
  const std::vector<BandNode> inner = inner_edges(begin, end);
  edges.insert(edges.end(), inner.begin(), inner.end());
  edges.push_back(edge_at(end, touches_down));
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    run.nodes.push_back(edges[i]);
    if (has_spring()) add_turns(edges[i], edges[i + 1], run.nodes);
  }
  run.nodes.push_back(edges.back());
  if (!touches_down) {
    run.nodes.back().lower = run.nodes.front().lower;
    run.nodes.back().upper = run.nodes.front().upper;
  }
  runs_.push_back(std::move(run));
}

void SliderBand::add_turns(const BandNode& from, const BandNode& to, std::vector<BandNode>& nodes) {
  const BandStretch stretch = stretch_between(from, to);
  const auto rates = [&](double offset) -> std::array<double, 2> {
    const BandInstant now = at(BandPlace{stretch.anchor, offset});
    return {now.velocity - now.reach_rate, now.velocity + now.reach_rate};
  };
  const auto rates_of_cell = [&](double middle, double half, const SmoothValues& shares,
                                 std::array<SmoothValues, 2>& values) {
    BandInstants now;
    at({stretch.anchor, middle, half, &shares}, now);
    for (std::size_t i = 0; i < n_band_nodes; ++i) {
      values[0][i] = now.motion.velocity[i] - now.reach_rate[i];
      values[1][i] = now.motion.velocity[i] + now.reach_rate[i];
    }
  };
  signs_.clear();
  // A wave of order H is resolved to 1e-11 on this length by the polynomials of the search.
  const double cell = 2.1 / n_harmonics();
  add_smooth_signs(SmoothFunctions{rates, rates_of_cell}, stretch.begin, stretch.end, cell, size_,
                   signs_);
  std::sort(signs_.begin(), signs_.end(),
            [](const SmoothSign& a, const SmoothSign& b) { return a.phase < b.phase; });
  for (const SmoothSign& sign : signs_) {
    const BandPlace place{stretch.anchor, sign.phase};
    const BandInstant now = at(place);
    nodes.push_back({place.phase(), now.lower(), now.upper(), false, false, place});
  }
}

}  // namespace microslip::contact
