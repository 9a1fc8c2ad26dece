#include "tests/support/sampled/sampled_motion.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "contact/numerics/trigonometric_moments.hpp"

namespace microslip::contact {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

SampleGrid make_grid(int n_samples, int n_harmonics) {
  SampleGrid grid{n_samples, n_harmonics, Eigen::MatrixXd(2 * n_harmonics + 1, n_samples)};
  std::vector<double> column;
  for (int j = 0; j < n_samples; ++j) {
    set_basis(two_pi * j / n_samples, n_harmonics, column);
    grid.basis.col(j) = Eigen::Map<const Eigen::VectorXd>(column.data(), grid.basis.rows());
  }
  return grid;
}

}  // namespace

const SampleGrid& sample_grid(int n_samples, int n_harmonics) {
  thread_local std::vector<std::unique_ptr<SampleGrid>> grids;
  for (const auto& grid : grids) {
    if (grid->n_samples == n_samples && grid->n_harmonics == n_harmonics) {
      return *grid;
    }
  }
  grids.push_back(std::make_unique<SampleGrid>(make_grid(n_samples, n_harmonics)));
  return *grids.back();
}

ContactSample contact_sample(const SurfaceLaw& law, double frequency, double u, double u_rate,
                             double v) {
  const SurfaceState state = law.at(v, frequency * std::abs(u_rate));
  const double k_u = law.first_stiffness();
  ContactSample now;
  now.u = u;
  now.u_rate = u_rate;
  now.v = v;
  now.load = state.load;
  now.load_by_v = state.load_by_approach;
  if (k_u == 0.0) {
    return now;
  }
  now.friction_coefficient = state.friction_coefficient;
  now.friction_coefficient_by_rate = state.friction_coefficient_by_rate;
  now.stiffness = k_u * state.stiffness_ratio;
  now.stiffness_by_v = k_u * state.stiffness_ratio_by_approach;
  if (!now.is_open()) {
    const double mu = state.friction_coefficient;
    now.half_width = mu * state.load_per_ratio / k_u;
    now.half_width_by_v = mu * state.load_per_ratio_by_approach / k_u;
    now.half_width_by_rate = state.friction_coefficient_by_rate * state.load_per_ratio / k_u;
  }
  return now;
}

void SampledMotion::set(const SurfaceLaw& law, const Harmonics& motion, double frequency,
                        const SampleGrid& grid) {
  const auto n = static_cast<std::size_t>(grid.n_samples);
  const Eigen::Index rows = motion.rows().rows();
  step_ = two_pi / grid.n_samples;
  frequency_ = frequency;
  samples_.resize(n);
  for (std::size_t j = 0; j < n; ++j) {
    const double* b = grid.basis.col(static_cast<Eigen::Index>(j)).data();
    double u = motion.rows()(0, 0);
    double v = motion.rows()(0, 1);
    double rate = 0.0;
    for (Eigen::Index i = 1; i < rows; i += 2) {
      const double h = 0.5 * static_cast<double>(i + 1);
      u += motion.rows()(i, 0) * b[i] + motion.rows()(i + 1, 0) * b[i + 1];
      v += motion.rows()(i, 1) * b[i] + motion.rows()(i + 1, 1) * b[i + 1];
      rate += h * (motion.rows()(i, 0) * b[i + 1] - motion.rows()(i + 1, 0) * b[i]);
    }
    samples_[j] = contact_sample(law, frequency, u, rate, v);
  }
  const std::vector<double> kinks = law.kinks();
  touches_at_kink_ = !kinks.empty();
  touch_ = touches_at_kink_ ? *std::min_element(kinks.begin(), kinks.end()) : 0.0;
  find_turns(law);
}

void SampledMotion::find_turns(const SurfaceLaw& law) {
  turns_.clear();
  turn_of_.assign(samples_.size(), -1);
  if (!law.is_rate_dependent()) {
    return;
  }
  for (int j = 0; j < size(); ++j) {
    const ContactSample& a = samples_[static_cast<std::size_t>(before(j))];
    const ContactSample& c = samples_[static_cast<std::size_t>(j)];
    const bool turns = (a.u_rate > 0.0 && c.u_rate < 0.0) || (a.u_rate < 0.0 && c.u_rate > 0.0);
    if (!turns || a.is_open() || c.is_open()) {
      continue;
    }
    const double x = turn_share(j);
    turn_of_[static_cast<std::size_t>(j)] = static_cast<int>(turns_.size());
    turns_.push_back(contact_sample(law, frequency_, a.u + 0.5 * step_ * x * a.u_rate, 0.0,
                                    (1.0 - x) * a.v + x * c.v));
  }
}

const ContactSample* SampledMotion::turn(int j) const {
  const int i = turn_of_[static_cast<std::size_t>(j)];
  return i < 0 ? nullptr : &turns_[static_cast<std::size_t>(i)];
}

double SampledMotion::turn_share(int j) const {
  const double a = (*this)[before(j)].u_rate;
  return a / (a - (*this)[j].u_rate);
}

double SampledMotion::touch_share(int j) const {
  const double a = (*this)[before(j)].v;
  const double c = (*this)[j].v;
  if (!touches_at_kink_ || a == c) {
    return 1.0;
  }
  return std::clamp((touch_ - a) / (c - a), 0.0, 1.0);
}

}  // namespace microslip::contact
