#include "contact/sampled/plane_block.hpp"

#include <algorithm>
#include <cmath>

#include "contact/lanes/line_kernels.hpp"

namespace microslip::contact::sampled {
namespace {

// Enough for (1); a march into rest may creep along a valley between two windows that push in turn.
constexpr int most_periods = 60;
// Periods after which the march is helped: a slider that comes to rest soon is left alone.
constexpr int first_jump = 3;
// Periods after which (1) should have found the cycle.
constexpr int slow_search = 8;
// A march that takes longer goes along a valley between two windows.
constexpr int slow_march = 20;
// Of the width of the ellipse: below what instants leave, above what rounding of a period does.
constexpr double settled = 1e-12;

}  // namespace

void PlaneBlock::resize() {
  const std::size_t n = instants_->size();
  for (auto* values :
       {&u_,      &v_,       &w_,       &rate_u_,    &rate_w_,    &closeness_, &normal_,
        &limit_,  &width_p_, &width_r_, &inverse_p_, &inverse_r_, &slider_p_,  &slider_r_,
        &pull_p_, &pull_r_,  &force_p_, &force_r_,   &state_,     &entry_}) {
    values->resize(n * block_size);
  }
  coefficients_.resize(3 * instants_->n_rows() * block_size);
  turns_.resize(n * n_turn_numbers * block_size);
  arrays_ = {n,
             u_.data(),
             w_.data(),
             closeness_.data(),
             width_p_.data(),
             width_r_.data(),
             inverse_p_.data(),
             inverse_r_.data(),
             slider_p_.data(),
             slider_r_.data(),
             pull_p_.data(),
             pull_r_.data(),
             state_.data(),
             entry_.data(),
             turns_.data()};
}

/// Directions without stiffness carry no friction: there the point does not move. Places without a
/// point repeat the first.
void PlaneBlock::load_motion(const PatchMotion& motion) {
  const std::size_t rows = instants_->n_rows();
  for (std::size_t p = 0; p < block_size; ++p) {
    const PointRows of_point = motion.of(point(p));
    const double along_p = stiffness_p_[p] > 0.0 ? 1.0 : 0.0;
    const double along_r = stiffness_r_[p] > 0.0 ? 1.0 : 0.0;
    for (std::size_t row = 0; row < rows; ++row) {
      const std::size_t to = instants_->split(row) * block_size + p;
      coefficients_[to] = along_p * of_point.u[row];
      coefficients_[rows * block_size + to] = of_point.v[row];
      coefficients_[2 * rows * block_size + to] = along_r * of_point.w[row];
    }
  }
  const LineKernels& kernels = line_kernels();
  const std::size_t n = instants_->size();
  const double* c = coefficients_.data();
  kernels.synthesize(n, rows, instants_->basis(), c, u_.data());
  kernels.synthesize(n, rows, instants_->basis(), c + rows * block_size, v_.data());
  kernels.synthesize(n, rows, instants_->basis(), c + 2 * rows * block_size, w_.data());
  if (simple_) return;
  kernels.synthesize(n, rows, instants_->rates(), c, rate_u_.data());
  kernels.synthesize(n, rows, instants_->rates(), c + 2 * rows * block_size, rate_w_.data());
}

void PlaneBlock::load_constants() {
  simple_ = equal_ = true;
  for (std::size_t p = 0; p < block_size; ++p) {
    const SurfaceLaw& surface = (*surfaces_)[static_cast<std::size_t>(point(p))];
    simple_ = simple_ && surface.is_smooth() && !surface.is_rate_dependent();
    const PointParameters& constants = surface.point();
    const bool slides = surface.has_friction();
    rest_load_[p] = constants.rest_load;
    normal_stiffness_[p] = constants.normal_stiffness;
    coefficient_[p] = constants.friction_coefficient;
    stiffness_p_[p] = slides ? surface.first_stiffness() : 0.0;
    stiffness_r_[p] = slides ? surface.second_stiffness() : 0.0;
    const bool plain = surface.at(0.0, 0.0).ratio_of_stiffness == 1.0;
    equal_ = equal_ && stiffness_p_[p] == stiffness_r_[p] && plain;
    closeness_by_approach_[p] = surface.is_smooth() ? constants.normal_stiffness : 1.0;
  }
}

void PlaneBlock::load_smooth() {
  const std::size_t n = instants_->size();
  std::array<double, block_size> compliance_p{}, compliance_r{};
  for (std::size_t p = 0; p < block_size; ++p) {
    // A direction without stiffness takes the width of the other: it does not move.
    const double k_p = stiffness_p_[p] > 0.0 ? stiffness_p_[p] : stiffness_r_[p];
    const double k_r = stiffness_r_[p] > 0.0 ? stiffness_r_[p] : stiffness_p_[p];
    compliance_p[p] = k_p > 0.0 ? coefficient_[p] / k_p : 0.0;
    compliance_r[p] = k_r > 0.0 ? coefficient_[p] / k_r : 0.0;
    smooth_slopes(p);
  }
  line_kernels().load(
      n, {rest_load_.data(), normal_stiffness_.data(), compliance_p.data(), stiffness_p_.data()},
      v_.data(), closeness_.data(), normal_.data(), width_p_.data());
  for (std::size_t at = 0; at < n * block_size; at += block_size) {
    for (std::size_t p = 0; p < block_size; ++p) {
      width_r_[at + p] = compliance_r[p] * normal_[at + p];
      limit_[at + p] = coefficient_[p] * normal_[at + p];
    }
  }
}

/// A step in which the contact opens or closes errs by more than others where the load is all that
/// drives: saw teeth along the curve, each as wide as the event takes from instant to instant.
void PlaneBlock::mend_load() {
  for (std::size_t p = 0; p < points_.size(); ++p) {
    load_kinks_[p].all.clear();
    if (!(*surfaces_)[static_cast<std::size_t>(point(p))].is_smooth()) continue;
    find_load_kinks(closeness_.data() + p, instants_->size(), load_kinks_[p]);
    mend(load_kinks_[p], instants_->size(), force_p_.data() + p, normal_.data() + p);
  }
}

void PlaneBlock::smooth_slopes(std::size_t p) {
  const double k_p = stiffness_p_[p] > 0.0 ? stiffness_p_[p] : stiffness_r_[p];
  const double k_r = stiffness_r_[p] > 0.0 ? stiffness_r_[p] : stiffness_p_[p];
  PlaneSlopes slopes;
  slopes.stiffness = {stiffness_p_[p], stiffness_r_[p]};
  slopes.load_by_approach = normal_stiffness_[p];
  slopes.limit_by_approach = coefficient_[p] * normal_stiffness_[p];
  if (k_p > 0.0)
    slopes.width_by_approach = {slopes.limit_by_approach / k_p, slopes.limit_by_approach / k_r};
  slopes_[p].assign(1, slopes);
}

/// Instant by instant and point by point: surfaces are a class with branches.
void PlaneBlock::ask_surfaces() {
  const std::size_t n = instants_->size();
  for (std::size_t p = 0; p < block_size; ++p) {
    const SurfaceLaw& surface = (*surfaces_)[static_cast<std::size_t>(point(p))];
    const bool smooth = surface.is_smooth();
    const double touch = smooth ? 0.0 : surface.kinks().front();
    const double k_p = stiffness_p_[p];
    const double k_r = stiffness_r_[p];
    const bool rubs = k_p > 0.0 || k_r > 0.0;
    slopes_[p].resize(n);
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t at = i * block_size + p;
      const double speed = std::hypot(rate_u_[at], rate_w_[at]);
      const SurfaceState now = surface.at(v_[at], frequency_ * speed);
      const double mu = rubs ? now.friction_coefficient : 0.0;
      const double by_rate = rubs ? now.friction_coefficient_by_rate : 0.0;
      closeness_[at] = smooth ? now.gap_load : v_[at] - touch;
      normal_[at] = now.load;
      limit_[at] = mu * now.load;
      PlaneSlopes& s = slopes_[p][i];
      s = {};
      s.stiffness = {k_p * now.stiffness_ratio, k_r * now.second_stiffness_ratio};
      s.stiffness_by_approach = {k_p * now.stiffness_ratio_by_approach,
                                 k_r * now.second_stiffness_ratio_by_approach};
      s.limit = limit_[at];
      s.limit_by_approach = mu * now.load_by_approach;
      s.limit_by_rate = by_rate * now.load;
      s.load_by_approach = now.load_by_approach;
      if (speed > 0.0) {
        s.rate_by_speed = {frequency_ * rate_u_[at] / speed, frequency_ * rate_w_[at] / speed};
      }
      s.rate_by_frequency = speed;
      // A direction without stiffness takes the width of the other: it does not move.
      const double c_p = rubs ? 1.0 / (k_p > 0.0 ? k_p : k_r) : 0.0;
      const double c_r = rubs ? 1.0 / (k_r > 0.0 ? k_r : k_p) : 0.0;
      const bool touching = closeness_[at] > 0.0;
      const double load_p = k_p > 0.0 ? now.load_per_ratio : now.second_load_per_ratio;
      const double load_r = k_r > 0.0 ? now.second_load_per_ratio : now.load_per_ratio;
      width_p_[at] = touching ? c_p * mu * load_p : 0.0;
      width_r_[at] = touching ? c_r * mu * load_r : 0.0;
      s.width_by_rate = {c_p * by_rate * load_p, c_r * by_rate * load_r};
      s.width_by_approach = {
          c_p * mu *
              (k_p > 0.0 ? now.load_per_ratio_by_approach : now.second_load_per_ratio_by_approach),
          c_r * mu *
              (k_r > 0.0 ? now.second_load_per_ratio_by_approach : now.load_per_ratio_by_approach)};
    }
  }
}

PlaneBlock::State PlaneBlock::virgin() const {
  State state{};
  plane_kernels().start(arrays_, state.data());
  return state;
}

void PlaneBlock::begin_search() {
  std::array<double, block_size> least{};
  std::array<double, block_size> most{};
  line_kernels().range(instants_->size(), closeness_.data(), least.data(), most.data());
  start_ = virgin();
  for (std::size_t p = 0; p < block_size; ++p) {
    search_[p] = {};
    search_[p].parts = least[p] <= 0.0;
    search_[p].settled = most[p] <= 0.0 || p >= points_.size();
  }
}

void PlaneBlock::settle() {
  const PlaneKernels& kernels = plane_kernels();
  std::array<double, block_size> slips{};
  for (int period = 0; period < most_periods; ++period) {
    if (std::ranges::all_of(search_, [](const Search& s) { return s.settled; })) break;
    const State before = start_;
    State end = start_;
    const bool looks = looks_for_corners(period);
    (looks ? kernels.record : kernels.march)(arrays_, equal_, end.data(), slips.data());
    for (std::size_t p = 0; p < block_size; ++p) {
      if (search_[p].settled || !search_[p].parts) continue;
      copy(end, p, start_);  // what was before touch-down does not matter
      search_[p].settled = true;
    }
    if (looks) rest_in_corners(end, slips, period >= slow_march);
    step_on(before, end, slips);
  }
  for (std::size_t p = 0; p < block_size; ++p) {
    const double stiffness = std::max(stiffness_p_[p], stiffness_r_[p]);
    defect_[p] = search_[p].settled ? 0.0 : search_[p].reach * stiffness;
  }
}

/// Before the march is helped for the first time, and where that has not been enough.
bool PlaneBlock::looks_for_corners(int period) const {
  if (period == first_jump - 1 || period >= slow_search) return true;
  return std::ranges::any_of(search_, [](const Search& s) { return !s.settled && s.marches; });
}

/// Of points that slip in the recorded period.
void PlaneBlock::rest_in_corners(const State& end, std::span<const double> slips, bool is_slow) {
  std::array<std::optional<std::array<std::size_t, 2>>, block_size> ends;
  for (std::size_t p = 0; p < points_.size(); ++p) {
    if (!search_[p].settled && slips[p] > 0.0) ends[p] = two_ends_of_slip(arrays_, p);
  }
  for (std::size_t p = 0; p < points_.size(); ++p) {
    if (ends[p].has_value()) search_[p].settled = rest_in_corner(p, *ends[p], end, is_slow);
  }
}

/// Whether both windows leave the slider in their corner. A slow march along the valley between
/// them may be taken over by a third before it: it is followed to the corner of the two that push
/// then. Writes over what is recorded.
bool PlaneBlock::rest_in_corner(std::size_t p, std::array<std::size_t, 2> instants, State state,
                                bool is_slow) {
  constexpr int most_windows = 4;
  std::array<double, block_size> slips{};
  for (int i = 0; i < most_windows; ++i) {
    const auto corner = meeting_corner(arrays_, p, instants, {state[p], state[block_size + p]});
    if (!corner.has_value()) return false;
    state[p] = corner->slider[0];
    state[block_size + p] = corner->slider[1];
    plane_kernels().start(arrays_, state.data());
    if (rests_throughout(arrays_, p, corner->slider)) {
      copy(state, p, start_);
      search_[p].corner = corner;
      return true;
    }
    if (!is_slow) return false;
    plane_kernels().record(arrays_, equal_, state.data(), slips.data());
    const auto next = two_ends_of_slip(arrays_, p);
    if (!next.has_value()) return false;
    instants = *next;
  }
  return false;
}

/// Points that (1) has brought to rest: where that is, is history. Whether there are any.
bool PlaneBlock::march_what_rests() {
  bool any = false;
  for (std::size_t p = 0; p < points_.size(); ++p) {
    Search& search = search_[p];
    const bool rests = runs_[p].size() == 1 && runs_[p][0].state == InstantState::stick;
    if (!search.settled || !search.jumped || !rests) continue;
    search.jumped = search.settled = false;
    search.marches = any = true;
    copy(march_, p, start_);
  }
  return any;
}

/// Of one point.
void PlaneBlock::copy(const State& from, std::size_t p, State& to) {
  for (std::size_t k = 0; k < n_state_numbers; ++k) {
    to[k * block_size + p] = from[k * block_size + p];
  }
}

/// (1) for one point that slips: where its next period is to begin,
/// if not where this one has ended.
bool PlaneBlock::jump(std::size_t p, const State& before, const State& end, State& next) {
  Search& search = search_[p];
  const auto along = [&](const State& s, std::size_t k) { return s[k * block_size + p]; };
  const std::array<double, 2> g = {along(end, 0) - along(before, 0),
                                   along(end, 1) - along(before, 1)};
  if (!search.jumped) ++search.periods;
  const double last = search.change_size;
  search.change_size = std::hypot(g[0], g[1]);
  const double widest = 2.0 * std::max(width_p_[p], width_r_[p]);
  if (!search.jumped) {
    // The sum of what follows, by the last ratio; that of a march in a valley creeps towards one,
    // and takes twice.
    const double left = last - search.change_size;
    search.reach = left > 0.0 ? std::min(widest, 2.0 * last * search.change_size / left) : widest;
  }
  if (search.change_size <= settled * std::max(width_p_[p], width_r_[p])) {
    search.settled = true;
    copy(end, p, start_);
    return false;
  }
  const std::array<double, 2> moved = {g[0] - search.change[0], g[1] - search.change[1]};
  const std::array<double, 2> ends = {along(end, 0) - search.end[0], along(end, 1) - search.end[1]};
  search.change = g;
  search.end = {along(end, 0), along(end, 1)};
  if (search.marches || search.periods < first_jump) return false;
  if (!search.jumped) copy(end, p, march_);
  const double square = moved[0] * moved[0] + moved[1] * moved[1];
  if (!(square > 0.0)) return false;
  const double share = (g[0] * moved[0] + g[1] * moved[1]) / square;
  next[p] = along(end, 0) - share * ends[0];
  next[block_size + p] = along(end, 1) - share * ends[1];
  // How far the secant sees the cycle, from the begin of the period.
  search.reach =
      std::min(widest, search.change_size + std::abs(share) * std::hypot(ends[0], ends[1]));
  search.jumped = true;
  return true;
}

/// From the end of a period to the begin of the next, of points that are not settled.
void PlaneBlock::step_on(const State& before, const State& end, std::span<const double> slips) {
  std::array<bool, block_size> jumps{};
  State next = end;
  for (std::size_t p = 0; p < block_size; ++p) {
    Search& search = search_[p];
    if (search.settled) continue;
    if (slips[p] > 0.0) {
      jumps[p] = jump(p, before, end, next);
    } else if (search.jumped) {  // rest: by the march alone
      search.jumped = false;
      search.marches = true;
      copy(march_, p, next);
    } else {
      search.settled = true;
    }
  }
  State started = next;
  plane_kernels().start(arrays_, started.data());
  for (std::size_t p = 0; p < block_size; ++p) {
    if (!search_[p].settled) copy(jumps[p] ? started : next, p, start_);
  }
}

PlaneStart PlaneBlock::start_of(const State& state, std::size_t place) const {
  const auto number = [&](std::size_t k) { return state[k * block_size + place]; };
  const InstantState kind = closeness_[place] <= 0.0 ? InstantState::separated
                            : number(4) > 0.0        ? InstantState::slip
                                                     : InstantState::stick;
  return {{number(0), number(1)}, {number(2), number(3)}, kind};
}

PlaneDerivatives::Point PlaneBlock::point_of(std::size_t place) const {
  return {&arrays_, place, slopes_[place].data(), simple_, closeness_by_approach_[place]};
}

/// Whether a point is where it is by its history: at rest, or on its way there.
bool PlaneBlock::has_history(std::size_t p) const {
  if (search_[p].corner.has_value()) return true;
  const bool rests = runs_[p].size() == 1 && runs_[p][0].state == InstantState::stick;
  return rests || search_[p].marches;
}

/// Of points that something has pushed to where they rest: all their periods again.
void PlaneBlock::keep_histories() {
  int most = 0;
  State state = virgin();
  for (std::size_t p = 0; p < points_.size(); ++p) {
    derivatives_[p].reset(*instants_);
    if (!has_history(p)) continue;
    if (search_[p].corner.has_value()) {
      derivatives_[p].begin_corner(point_of(p), *search_[p].corner);
      continue;
    }
    derivatives_[p].begin_history(point_of(p), start_of(state, p));
    most = std::max(most, search_[p].periods);
  }
  std::array<double, block_size> slips{};
  for (int period = 0; period < most; ++period) {
    const State begin = state;
    plane_kernels().linearise(arrays_, equal_, state.data(), slips.data());
    for (std::size_t p = 0; p < points_.size(); ++p) {
      const bool carries = has_history(p) && !search_[p].corner.has_value();
      if (!carries || period >= search_[p].periods) continue;
      derivatives_[p].carry_history(point_of(p), start_of(begin, p));
    }
  }
  if (most == 0) return;
  state = start_;
  plane_kernels().linearise(arrays_, equal_, state.data(), slips.data());
}

/// The steady period, with what derivatives need.
void PlaneBlock::record(Ask ask) {
  const std::size_t n = instants_->size();
  const PlaneKernels& kernels = plane_kernels();
  std::array<double, block_size> slips{};
  State state = start_;
  (ask == Ask::derivatives ? kernels.linearise : kernels.record)(arrays_, equal_, state.data(),
                                                                 slips.data());
  for (std::size_t p = 0; p < points_.size(); ++p) {
    find_runs(state_.data() + p, n, block_size, runs_[p]);
  }
}

void PlaneBlock::evaluate(const std::vector<SurfaceLaw>& surfaces, const PatchMotion& motion,
                          std::span<const Eigen::Index> points, double frequency, Ask ask,
                          const Instants& of_motion, const Instants& of_force) {
  surfaces_ = &surfaces;
  points_ = points;
  frequency_ = frequency;
  instants_ = &of_motion;
  resize();
  load_constants();
  load_motion(motion);
  if (simple_) {
    load_smooth();
  } else {
    ask_surfaces();
  }
  const std::size_t n = of_motion.size();
  plane_kernels().invert(n, width_p_.data(), inverse_p_.data());
  plane_kernels().invert(n, width_r_.data(), inverse_r_.data());
  begin_search();
  settle();
  record(ask);
  if (march_what_rests()) {
    settle();
    record(ask);
  }
  if (ask == Ask::derivatives) keep_histories();
  for (std::size_t at = 0; at < n * block_size; ++at) {
    force_p_[at] = limit_[at] * pull_p_[at];
    force_r_[at] = limit_[at] * pull_r_[at];
  }
  mend_load();
  const std::array<const double*, 3> signal{force_p_.data(), normal_.data(), force_r_.data()};
  for (std::size_t s = 0; s < 3; ++s) {
    sums_[s].resize(of_force.n_rows() * block_size);
    line_kernels().analyze(n, of_force.n_rows(), of_force.n_rows(), of_force.basis(), signal[s],
                           sums_[s].data());
  }
}

const PlaneDerivatives& PlaneBlock::derivatives(std::size_t place) {
  if (has_history(place)) {
    derivatives_[place].after_history(point_of(place), start_of(start_, place), runs_[place]);
  } else {
    derivatives_[place].steady(point_of(place), runs_[place]);
  }
  derivatives_[place].mend_load(load_kinks_[place], normal_stiffness_[place]);
  return derivatives_[place];
}

double PlaneBlock::slip_work(std::size_t place) const {
  const std::size_t n = instants_->size();
  double work = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t now = i * block_size + place;
    const std::size_t before = (i + n - 1) % n * block_size + place;
    if (instant_state(state_[now]) != InstantState::slip) continue;
    double start_p = slider_p_[before];
    double start_r = slider_r_[before];
    double limit = limit_[before];
    if (closeness_[before] <= 0.0) {
      const double x = -closeness_[before] / (closeness_[now] - closeness_[before]);
      start_p = u_[before] + x * (u_[now] - u_[before]);
      start_r = w_[before] + x * (w_[now] - w_[before]);
      limit = 0.0;
    } else if (instant_state(state_[before]) == InstantState::stick) {
      limit = limit_[now];
    }
    work += 0.5 * (limit + limit_[now]) *
            std::hypot(slider_p_[now] - start_p, slider_r_[now] - start_r);
  }
  return work;
}

}  // namespace microslip::contact::sampled
