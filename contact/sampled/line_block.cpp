#include "contact/sampled/line_block.hpp"

#include <algorithm>
#include <cmath>

#include "contact/sampled/slip_work.hpp"

namespace microslip::contact::sampled {

void LineBlock::resize(const Instants& of_motion, const Instants& of_force) {
  instants_ = &of_motion;
  const std::size_t size = of_motion.size() * block_size;
  for (auto* values : {&u_, &v_, &rate_, &closeness_, &half_width_, &normal_, &low_, &high_,
                       &turns_, &landed_, &slider_, &friction_, &state_}) {
    values->resize(size);
  }
  coefficients_.resize(2 * of_motion.n_rows() * block_size);
  friction_sums_.resize(of_force.n_rows() * block_size);
  normal_sums_.resize(of_force.n_rows() * block_size);
}

/// Coefficients of u, then of v, in split order; places without a point repeat the first.
void LineBlock::load_motion(const PatchMotion& motion, std::span<const Eigen::Index> points) {
  const std::size_t rows = instants_->n_rows();
  for (std::size_t p = 0; p < block_size; ++p) {
    const PointRows point = motion.of(p < points.size() ? points[p] : points[0]);
    for (std::size_t row = 0; row < rows; ++row) {
      const std::size_t to = instants_->split(row) * block_size + p;
      coefficients_[to] = point.u[row];
      coefficients_[rows * block_size + to] = point.v[row];
    }
  }
}

void LineBlock::smooth_constants(std::span<const Eigen::Index> points) {
  simple_ = true;
  for (std::size_t p = 0; p < block_size; ++p) {
    const auto i = static_cast<std::size_t>(p < points.size() ? points[p] : points[0]);
    const SurfaceLaw& surface = (*surfaces_)[i];
    simple_ = simple_ && surface.is_smooth() && !surface.is_rate_dependent();
    const PointParameters& point = surface.point();
    const bool rubs = point.rubs();
    rest_load_[p] = point.rest_load;
    normal_stiffness_[p] = point.normal_stiffness;
    stiffness_[p] = rubs ? point.tangential_stiffness : 0.0;
    coefficient_[p] = rubs ? point.friction_coefficient : 0.0;
    compliant_friction_[p] = rubs ? point.friction_coefficient / point.tangential_stiffness : 0.0;
  }
}

bool LineBlock::touches() {
  std::array<double, block_size> least{};
  std::array<double, block_size> most{};
  line_kernels().range(instants_->size(), closeness_.data(), least.data(), most.data());
  bool any = false;
  for (std::size_t p = 0; p < block_size; ++p) any = any || (least[p] <= 0.0 && most[p] > 0.0);
  return any;
}

void LineBlock::march_smooth() {
  const std::size_t n = instants_->size();
  const SmoothArrays constants{rest_load_.data(), normal_stiffness_.data(),
                               compliant_friction_.data(), stiffness_.data()};
  line_kernels().load(n, constants, v_.data(), closeness_.data(), normal_.data(),
                      half_width_.data());
  const bool touches = this->touches();
  line_kernels().turning_band(n, constants, u_.data(), closeness_.data(), half_width_.data(),
                              {low_.data(), high_.data(), turns_.data(), landed_.data()}, touches);
  line_kernels().march(arrays(), touches);
  line_kernels().friction(n, constants, u_.data(), slider_.data(), friction_.data());
}

LineArrays LineBlock::arrays() {
  LineArrays all{.n_instants = instants_->size(),
                 .u = u_.data(),
                 .closeness = closeness_.data(),
                 .low = low_.data(),
                 .high = high_.data(),
                 .slider = slider_.data(),
                 .state = state_.data()};
  if (!simple_) return all;
  all.half_width = half_width_.data();
  all.turns = turns_.data();
  all.landed = landed_.data();
  return all;
}

SmoothPoint LineBlock::smooth_point(std::size_t place) const {
  return {stiffness_[place], normal_stiffness_[place], coefficient_[place]};
}

void LineBlock::mend_kinks(std::size_t n_points) {
  for (std::size_t p = 0; p < n_points; ++p) {
    const std::size_t n = instants_->size();
    if (simple_) {
      find_kinks(smooth_point(p), runs_[p], columns(p), n, kinks_[p]);
    } else if ((*surfaces_)[static_cast<std::size_t>(points_[p])].is_smooth()) {
      find_load_kinks(closeness_.data() + p, n, kinks_[p]);
    } else {
      kinks_[p].all.clear();
    }
    mend(kinks_[p], n, friction_.data() + p, normal_.data() + p);
  }
}

/// Instant by instant and point by point: surfaces are a class with branches.
void LineBlock::ask_surfaces(std::span<const Eigen::Index> points) {
  const std::size_t n = instants_->size();
  for (std::size_t p = 0; p < block_size; ++p) {
    const auto point = static_cast<std::size_t>(p < points.size() ? points[p] : points[0]);
    const SurfaceLaw& surface = (*surfaces_)[point];
    const bool smooth = surface.is_smooth();
    const double k_u = surface.first_stiffness();
    const double compliance = k_u > 0.0 ? 1.0 / k_u : 0.0;
    const double touch = smooth ? 0.0 : surface.kinks().front();
    closeness_by_approach_[p] = smooth ? surface.point().normal_stiffness : 1.0;
    slopes_[p].resize(n);
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t at = i * block_size + p;
      const SurfaceState now = surface.at(v_[at], frequency_ * std::abs(rate_[at]));
      const double mu = k_u > 0.0 ? now.friction_coefficient : 0.0;
      const double mu_by_rate = k_u > 0.0 ? now.friction_coefficient_by_rate : 0.0;
      closeness_[at] = smooth ? now.gap_load : v_[at] - touch;
      normal_[at] = now.load;
      const double half_width = closeness_[at] > 0.0 ? mu * now.load_per_ratio * compliance : 0.0;
      low_[at] = u_[at] - half_width;
      high_[at] = u_[at] + half_width;
      slopes_[p][i] = {k_u * now.stiffness_ratio,
                       k_u * now.stiffness_ratio_by_approach,
                       mu * now.load_by_approach,
                       mu_by_rate * now.load,
                       mu * now.load_per_ratio_by_approach * compliance,
                       mu_by_rate * now.load_per_ratio * compliance,
                       now.load_by_approach,
                       rate_[at]};
    }
  }
}

void LineBlock::evaluate(const std::vector<SurfaceLaw>& surfaces, const PatchMotion& motion,
                         std::span<const Eigen::Index> points, double frequency,
                         const Instants& of_motion, const Instants& of_force) {
  surfaces_ = &surfaces;
  points_ = points;
  frequency_ = frequency;
  resize(of_motion, of_force);
  load_motion(motion, points);
  smooth_constants(points);
  const std::size_t n = of_motion.size();
  const std::size_t rows = of_motion.n_rows();
  const LineKernels& kernels = line_kernels();
  const double* of_v = coefficients_.data() + rows * block_size;
  kernels.synthesize(n, rows, of_motion.basis(), coefficients_.data(), u_.data());
  kernels.synthesize(n, rows, of_motion.basis(), of_v, v_.data());
  if (simple_) {
    march_smooth();
  } else {
    kernels.synthesize(n, rows, of_motion.rates(), coefficients_.data(), rate_.data());
    ask_surfaces(points);
    kernels.march(arrays(), touches());
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t p = 0; p < block_size; ++p) {
        const std::size_t at = i * block_size + p;
        friction_[at] = slopes_[p][i].stiffness * (u_[at] - slider_[at]);
      }
    }
  }
  for (std::size_t p = 0; p < points.size(); ++p) {
    find_runs(state_.data() + p, n, block_size, runs_[p]);
  }
  mend_kinks(points.size());
  kernels.analyze(n, of_force.n_rows(), of_force.n_rows(), of_force.basis(), friction_.data(),
                  friction_sums_.data());
  kernels.analyze(n, of_force.n_rows(), of_force.n_rows(), of_force.basis(), normal_.data(),
                  normal_sums_.data());
}

LineColumns LineBlock::columns(std::size_t place) const {
  return {u_.data() + place,
          closeness_.data() + place,
          low_.data() + place,
          high_.data() + place,
          simple_ ? turns_.data() + place : nullptr,
          slider_.data() + place};
}

const LineDerivatives& LineBlock::derivatives(std::size_t place) {
  derivatives_.reset(*instants_);
  if (simple_) {
    derivatives_.smooth(smooth_point(place), runs_[place], kinks_[place], columns(place));
  } else {
    derivatives_.any_surface(slopes_[place], closeness_by_approach_[place], frequency_,
                             runs_[place], columns(place));
    derivatives_.mend_load(kinks_[place], normal_stiffness_[place]);
  }
  return derivatives_;
}

double LineBlock::slip_work(std::size_t place) const {
  const std::size_t n = instants_->size();
  if (simple_) return sampled::slip_work(smooth_point(place), columns(place), &state_[place], n);
  double work = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t now = i * block_size + place;
    const std::size_t before = (i + n - 1) % n * block_size + place;
    const InstantState state = instant_state(state_[now]);
    if (state == InstantState::separated || state == InstantState::stick) continue;
    double start = slider_[before];
    double limit = std::abs(friction_[before]);
    if (closeness_[before] <= 0.0) {
      const double x = -closeness_[before] / (closeness_[now] - closeness_[before]);
      start = u_[before] + x * (u_[now] - u_[before]);
      limit = 0.0;
    } else if (instant_state(state_[before]) == InstantState::stick) {
      limit = std::abs(friction_[now]);
    }
    work += 0.5 * (limit + std::abs(friction_[now])) * std::abs(slider_[now] - start);
  }
  return work;
}

}  // namespace microslip::contact::sampled
