#include "solver/balance/output_amplitude.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include "contact/phase.hpp"

namespace microslip::solver {
namespace {

/// Output of one signal, its slope and curvature at a phase. `y` holds [y₀, y_s1, y_c1, …].
struct Wave {
  Eigen::VectorXd y;

  [[nodiscard]] double derivative(double phase, int order) const {
    double value = order == 0 ? y[0] : 0.0;
    for (Eigen::Index h = 1; 2 * h < y.size(); ++h) {
      const double turn = 0.5 * std::numbers::pi * order;  // d/dθ shifts by a quarter
      const double angle = static_cast<double>(h) * phase + turn;
      value += std::pow(static_cast<double>(h), order) *
               (y[2 * h - 1] * std::sin(angle) + y[2 * h] * std::cos(angle));
    }
    return value;
  }
};

/// Phase of the largest value of sign · y: the best of a grid, then Newton on the slope.
double phase_of_extremum(const Wave& wave, double sign) {
  const auto n_grid = 32 * wave.y.size();
  double best = 0.0;
  double value = -std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < n_grid; ++i) {
    const double phase = contact::two_pi * static_cast<double>(i) / static_cast<double>(n_grid);
    if (const double here = sign * wave.derivative(phase, 0); here > value) {
      value = here;
      best = phase;
    }
  }
  const double cell = contact::two_pi / static_cast<double>(n_grid);
  double phase = best;
  for (int i = 0; i < 20; ++i) {
    const double curvature = wave.derivative(phase, 2);
    if (sign * curvature >= 0.0) break;  // flat: the grid value is as good
    const double step = wave.derivative(phase, 1) / curvature;
    if (std::abs(phase - step - best) > cell) break;
    phase -= step;
    if (std::abs(step) < 1e-15) break;
  }
  return phase;
}

/// Weights of [y₀, y_s1, y_c1, …] in y(θ).
Eigen::VectorXd basis(Eigen::Index n_rows, double phase) {
  Eigen::VectorXd values(n_rows);
  values[0] = 1.0;
  for (Eigen::Index h = 1; 2 * h < n_rows; ++h) {
    values[2 * h - 1] = std::sin(static_cast<double>(h) * phase);
    values[2 * h] = std::cos(static_cast<double>(h) * phase);
  }
  return values;
}

Eigen::VectorXd gradient_of(const Eigen::VectorXd& weights, const Eigen::VectorXd& output) {
  contact::Harmonics::Matrix rows = weights * output.transpose();
  return Eigen::Map<const Eigen::VectorXd>(rows.data(), rows.size());
}

}  // namespace

OutputAmplitude output_amplitude(const contact::Harmonics& q, const Eigen::VectorXd& output) {
  const Wave wave{q.rows() * output};
  const auto& y = wave.y;
  OutputAmplitude result;
  result.mean = y[0];
  result.first_harmonic = std::hypot(y[1], y[2]);
  result.phase = std::atan2(y[2], y[1]);
  if (y.size() == 3) {
    result.half_peak_to_peak = result.first_harmonic;
    Eigen::VectorXd weights = Eigen::VectorXd::Zero(3);
    if (result.first_harmonic > 0.0) weights.tail(2) = y.tail(2) / result.first_harmonic;
    result.gradient = gradient_of(weights, output);
    return result;
  }
  const double high = phase_of_extremum(wave, 1.0);
  const double low = phase_of_extremum(wave, -1.0);
  result.half_peak_to_peak = 0.5 * (wave.derivative(high, 0) - wave.derivative(low, 0));
  result.gradient = gradient_of(0.5 * (basis(y.size(), high) - basis(y.size(), low)), output);
  return result;
}

}  // namespace microslip::solver
