#include "tests/support/sampled/sampled_force.hpp"

#include <array>
#include <cmath>
#include <numbers>

namespace microslip::contact {
namespace {

constexpr double pi = std::numbers::pi;

double norm(int i) { return i == 0 ? 0.5 / pi : 1.0 / pi; }

// Rows and columns of a Jacobian of n_point_signals signals.
enum Signal : int { tangential = 0, perpendicular = 1 };
Eigen::Index entry(int i, Signal signal) { return n_point_signals * i + signal; }

double sign_of(ContactState state) {
  if (state == ContactState::positive_slip) {
    return 1.0;
  }
  return state == ContactState::negative_slip ? -1.0 : 0.0;
}

// ∫ b_i b_j' from moments: the derivative of the basis is the basis, turned and scaled.
double product_with_rate(const TrigonometricMoments& moments, int i, int j) {
  if (j == 0) {
    return 0.0;
  }
  const int h = (j + 1) / 2;
  return j % 2 == 1 ? h * moments.product(i, j + 1) : -h * moments.product(i, j - 1);
}

}  // namespace

double sampled_friction(const ContactSample& at, const SliderSample& slider) {
  if (slider.state == ContactState::stick) {
    return at.stiffness * (at.u - slider.slider);
  }
  return sign_of(slider.state) * at.limit();
}

void SampledForce::set_weights(const SampledMotion& motion, const SampledSlider& slider) {
  weights_.setZero(motion.size(), n_columns);
  for (int j = 0; j < motion.size(); ++j) {
    const ContactSample& at = motion[j];
    const SliderSample& now = slider[j];
    if (now.state == ContactState::separated) {
      continue;
    }
    weights_(j, normal) = at.load;
    weights_(j, load_by_v) = at.load_by_v;
    weights_(j, friction) = sampled_friction(at, now);
    if (now.state == ContactState::stick) {
      weights_(j, by_u) = at.stiffness;
      weights_(j, by_v) = at.stiffness_by_v * (at.u - now.slider);
      continue;
    }
    const double sign = sign_of(now.state);
    const double rise = sign * at.friction_coefficient_by_rate * at.load;
    weights_(j, by_v) = sign * at.friction_coefficient * at.load_by_v;
    weights_(j, by_rate) =
        rise * motion.frequency() * (at.u_rate > 0.0 ? 1.0 : (at.u_rate < 0.0 ? -1.0 : 0.0));
    weights_(j, by_frequency) = rise * std::abs(at.u_rate);
  }
}

Harmonics SampledForce::force(const SampledMotion& motion, const SampledSlider& slider,
                              const SampleGrid& grid, int n_harmonics) {
  set_weights(motion, slider);
  Harmonics force(n_harmonics, n_point_signals);
  for (int i = 0; i < 2 * n_harmonics + 1; ++i) {
    for (const Column column : {friction, normal}) {
      force.rows()(i, column) =
          norm(i) * motion.step() * grid.basis.row(i).dot(weights_.col(column).transpose());
    }
  }
  return force;
}

void SampledForce::set_springs(const SampledMotion& motion, int n_harmonics,
                               PointTraction& result) {
  const std::array<TrigonometricMoments*, 4> moments{&stiffness_, &coupling_, &normal_, &rate_};
  constexpr std::array<Column, 4> columns{by_u, by_v, load_by_v, by_rate};
  for (std::size_t k = 0; k < moments.size(); ++k) {
    moments[k]->reset(2 * n_harmonics);
    moments[k]->set_sums(sums_.col(columns[k]).data());
  }
  const int n = 2 * n_harmonics + 1;
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const double g = norm(i) * motion.step();
      result.jacobian(entry(i, perpendicular), entry(j, perpendicular)) = g * normal_.product(i, j);
      result.jacobian(entry(i, tangential), entry(j, perpendicular)) = g * coupling_.product(i, j);
      result.jacobian(entry(i, tangential), entry(j, tangential)) =
          g * (stiffness_.product(i, j) + product_with_rate(rate_, i, j));
    }
  }
}

// The slider's part −k g_p ds of each stretch of stick, one and the same ds within it.
void SampledForce::add_memory(const SampledSlider& slider, const SliderMemory& memory,
                              const SampleGrid& grid, int n_harmonics, double step,
                              PointTraction& result) {
  slider.differentiate(memory, grid, n_harmonics, derivative_);
  const int n = 2 * n_harmonics + 1;
  for (int i = 0; i < n; ++i) {
    const double g = -norm(i) * step * stretch_[i];
    for (int j = 0; j < n; ++j) {
      result.jacobian(entry(i, tangential), entry(j, tangential)) += g * derivative_.by_u[j];
      result.jacobian(entry(i, tangential), entry(j, perpendicular)) += g * derivative_.by_v[j];
    }
    result.frequency_derivative[entry(i, tangential)] += g * derivative_.by_frequency;
  }
}

void SampledForce::add_memories(const SampledMotion& motion, const SampledSlider& slider,
                                const SampleGrid& grid, int n_harmonics, PointTraction& result) {
  const Eigen::Index n = 2 * n_harmonics + 1;
  stretch_.setZero(n);
  for (int j = 0; j < motion.size(); ++j) {
    if (slider[j].state != ContactState::stick) {
      continue;
    }
    stretch_ += motion[j].stiffness * grid.basis.col(j).head(n);
    const bool ends = j + 1 == motion.size() || slider[j + 1].state != ContactState::stick ||
                      !(slider[j + 1].memory == slider[j].memory);
    if (ends) {
      add_memory(slider, slider[j].memory, grid, n_harmonics, motion.step(), result);
      stretch_.setZero();
    }
  }
}

void SampledForce::traction(const SampledMotion& motion, const SampledSlider& slider,
                            const SampleGrid& grid, int n_harmonics, PointTraction& result) {
  const int n = 2 * n_harmonics + 1;
  const Eigen::Index size = n_point_signals * n;
  set_weights(motion, slider);
  sums_.noalias() = grid.basis.topRows(4 * n_harmonics + 1) * weights_;
  if (result.force.n_harmonics() != n_harmonics || result.force.n_signals() != n_point_signals) {
    result.force = Harmonics(n_harmonics, n_point_signals);
  }
  result.jacobian.setZero(size, size);
  result.frequency_derivative.setZero(size);
  result.regime = slider.regime();
  for (int j = 0; j < motion.size(); ++j) {
    result.period.set(slider[j].state, (j - 0.5) * motion.step(), motion.step());
  }
  for (int i = 0; i < n; ++i) {
    const double g = norm(i) * motion.step();
    result.force.rows().row(i) << g * sums_(i, friction), g * sums_(i, normal), 0.0;
    result.frequency_derivative[entry(i, tangential)] = g * sums_(i, by_frequency);
  }
  set_springs(motion, n_harmonics, result);
  add_memories(motion, slider, grid, n_harmonics, result);
}

}  // namespace microslip::contact
