#include "contact/surface/linear_range.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace microslip::contact {
namespace {

// Proofs are made in doubles: what is left after cancelling to this share of the terms proves
// nothing.
constexpr double rounding = 1e-12;

double dot(const Eigen::MatrixXd& basis, Eigen::Index j, const double* row) {
  const double* b = basis.data() + j * basis.rows();
  return std::inner_product(b, b + basis.rows(), row, 0.0);
}

// Sums over the harmonics, in shares of the load or limit they are held against, so that squares
// neither vanish nor overflow where it matters.
struct Amplitudes {
  double sum = 0.0;    // largest of the dynamic part
  double curve = 0.0;  // Σ h² amplitude_h

  void add(int h, double amplitude) {
    sum += amplitude;
    curve += static_cast<double>(h) * h * amplitude;
  }
};

// Largest length of S sin θ + C cos θ for S = (u_s, w_s), C = (u_c, w_c).
double half_axis(double us, double uc, double ws, double wc) {
  const double whole = us * us + uc * uc + ws * ws + wc * wc;
  const double difference = uc * uc + wc * wc - us * us - ws * ws;
  const double product = 2.0 * (us * uc + ws * wc);
  return std::sqrt(0.5 * (whole + std::sqrt(difference * difference + product * product)));
}

void add_normal(const double* v, double scale, int n_harmonics, Amplitudes& sums) {
  for (int h = 1; h <= n_harmonics; ++h) {
    const double s = scale * v[2 * h - 1];
    const double c = scale * v[2 * h];
    sums.add(h, std::sqrt(s * s + c * c));
  }
}

void add_tangential(const PointRows& x, double p, double r, int n_harmonics, Amplitudes& sums) {
  for (int h = 1; h <= n_harmonics; ++h) {
    const double us = p * x.u[2 * h - 1];
    const double uc = p * x.u[2 * h];
    // NOLINTNEXTLINE(clang-analyzer-core.NullDereference): r is 0 without motion along r
    sums.add(h, r > 0.0 ? half_axis(us, uc, r * x.w[2 * h - 1], r * x.w[2 * h])
                        : std::sqrt(us * us + uc * uc));
  }
}

// Smallest μ of the period.
double least_friction(const LinearRange& range, const PointRows& x, int n_harmonics,
                      double frequency) {
  const double at_rest = range.friction.at_rest();
  if (!range.friction.is_rate_dependent()) return at_rest;
  double fastest = 0.0;
  for (int h = 1; h <= n_harmonics; ++h) {
    double speed = std::hypot(x.u[2 * h - 1], x.u[2 * h]);
    if (x.w != nullptr) speed += std::hypot(x.w[2 * h - 1], x.w[2 * h]);
    fastest += static_cast<double>(h) * speed;
  }
  return std::min(at_rest, range.friction.at(std::abs(frequency) * fastest).value);
}

// What the terms of n₀ have lost by cancelling.
double cancelled(const LinearRange& range, const PointRows& x, double bias_load) {
  return (std::abs(range.rest_load) + std::abs(range.stiffness[1] * x.v[0])) / std::abs(bias_load);
}

bool stays_open(const LinearRange& range, const PointRows& x, const PhaseTable& table,
                double bias_load, double reserve) {
  const double scale = range.stiffness[1] / -bias_load;
  Amplitudes load;
  add_normal(x.v, scale, table.n_harmonics, load);
  const double needed =
      reserve / -bias_load + rounding * (1.0 + load.sum + cancelled(range, x, bias_load));
  if (1.0 - load.sum > needed) return true;
  const double least = needed + table.rise * load.curve;
  for (Eigen::Index j = 0; j < table.basis.cols(); ++j) {
    const double moving = dot(table.basis, j, x.v) - x.v[0];
    if (!(1.0 - scale * moving > least)) return false;
  }
  return true;
}

bool stays_stuck(const LinearRange& range, const PointRows& x, const PhaseTable& table,
                 double bias_load, double friction, double reserve) {
  const double limit = friction * bias_load;
  if (!(limit > 0.0)) return false;
  const double normal = range.stiffness[1] / bias_load;
  const double p = range.stiffness[0] / limit;
  const double r = x.w != nullptr ? range.stiffness[2] / limit : 0.0;
  Amplitudes all;
  add_normal(x.v, normal, table.n_harmonics, all);
  add_tangential(x, p, r, table.n_harmonics, all);
  // NOLINTNEXTLINE(clang-analyzer-core.NullDereference): r is 0 without motion along r
  const double mean = std::hypot(p * x.u[0], r > 0.0 ? r * x.w[0] : 0.0);
  const double needed =
      reserve / limit + rounding * (1.0 + mean + all.sum + cancelled(range, x, bias_load));
  if (1.0 - mean - all.sum > needed) return true;
  const double least = needed + table.rise * all.curve;
  for (Eigen::Index j = 0; j < table.basis.cols(); ++j) {
    const double load = 1.0 + normal * (dot(table.basis, j, x.v) - x.v[0]);
    const double along_p = p * dot(table.basis, j, x.u);
    const double along_r = r > 0.0 ? r * dot(table.basis, j, x.w) : 0.0;
    if (!(load - std::sqrt(along_p * along_p + along_r * along_r) > least)) return false;
  }
  return true;
}

}  // namespace

PhaseTable::PhaseTable(int harmonics) : n_harmonics(harmonics) {
  const int n = 16 * (harmonics + 1);
  int stride = static_cast<int>(0.618 * n);
  while (std::gcd(stride, n) != 1) ++stride;
  basis.resize(2 * harmonics + 1, n);
  for (int j = 0; j < n; ++j) {
    const double phase = 2.0 * std::numbers::pi * (j * stride % n) / n;
    basis(0, j) = 1.0;
    for (int h = 1; h <= harmonics; ++h) {
      basis(2 * h - 1, j) = std::sin(h * phase);
      basis(2 * h, j) = std::cos(h * phase);
    }
  }
  const double half_step = std::numbers::pi / n;
  rise = 0.5 * half_step * half_step;
}

LinearReserve reserve_of_reach(const LinearRange& range, const Eigen::Vector3d& reach) {
  const double load = range.stiffness[1] * reach[1];
  if (!range.rubs()) return {load, load};
  const double tangential =
      std::hypot(range.stiffness[0] * reach[0], range.stiffness[2] * reach[2]);
  return {range.friction.at_rest() * load + tangential, load};
}

LinearReserve reserve_of_ball(const LinearRange& range, const Eigen::Vector3d& sizes,
                              int n_harmonics, double radius) {
  if (std::isinf(radius)) return {radius, radius};
  return reserve_of_reach(range, std::sqrt(1.0 + n_harmonics) * radius * sizes);
}

SleepState sleep_state(const LinearRange& range, const PointRows& motion, const PhaseTable& table,
                       double frequency, const LinearReserve& reserve) {
  const double bias_load = std::fma(range.stiffness[1], motion.v[0], range.rest_load);
  if (bias_load < 0.0) {
    return stays_open(range, motion, table, bias_load, reserve.open) ? SleepState::open
                                                                     : SleepState::awake;
  }
  if (!range.sticks_linearly) return SleepState::awake;
  const double friction =
      range.rubs() ? least_friction(range, motion, table.n_harmonics, frequency) : 1.0;
  return stays_stuck(range, motion, table, bias_load, friction, reserve.stuck) ? SleepState::stuck
                                                                               : SleepState::awake;
}

}  // namespace microslip::contact
