#include "solver/balance/output_amplitude.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include "contact/phase.hpp"
#include "contact/trigonometric_basis.hpp"

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

/// Weights of [y₀, y_s1, y_c1, …] in y(θ).
Eigen::VectorXd weights_at(const Eigen::VectorXd& y, double phase) {
  Eigen::VectorXd values;
  contact::trigonometric_basis(static_cast<int>(y.size() / 2), phase, values);
  return values;
}

/// Phases of a grid where y is largest and smallest.
struct GridExtrema {
  double high = 0.0, low = 0.0, cell = 0.0;  // [rad]
};

GridExtrema extrema_on_grid(const Eigen::VectorXd& y) {
  const auto n_grid = 32 * y.size();
  GridExtrema found;
  found.cell = contact::two_pi / static_cast<double>(n_grid);
  double largest = -std::numeric_limits<double>::infinity();
  double smallest = -largest;
  Eigen::VectorXd weights;  // by recurrence: a sine for each harmonic would cost as much as a force
  for (Eigen::Index i = 0; i < n_grid; ++i) {
    const double phase = found.cell * static_cast<double>(i);
    contact::trigonometric_basis(static_cast<int>(y.size() / 2), phase, weights);
    const double here = weights.dot(y);
    if (here > largest) {
      largest = here;
      found.high = phase;
    }
    if (here < smallest) {
      smallest = here;
      found.low = phase;
    }
  }
  return found;
}

/// Phase of the largest value of sign · y within a cell of `best`, by Newton on the slope.
double phase_of_extremum(const Wave& wave, double sign, double best, double cell) {
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
  const GridExtrema grid = extrema_on_grid(y);
  const double high = phase_of_extremum(wave, 1.0, grid.high, grid.cell);
  const double low = phase_of_extremum(wave, -1.0, grid.low, grid.cell);
  result.half_peak_to_peak = 0.5 * (wave.derivative(high, 0) - wave.derivative(low, 0));
  result.gradient = gradient_of(0.5 * (weights_at(y, high) - weights_at(y, low)), output);
  return result;
}

}  // namespace microslip::solver
