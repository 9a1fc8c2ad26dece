#include "contact/numerics/trigonometric_moments.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

namespace microslip::contact {

void set_basis(double phase, int n_harmonics, std::vector<double>& values) {
  values.resize(2 * static_cast<std::size_t>(n_harmonics) + 1);
  const double s = std::sin(phase);
  const double c = std::cos(phase);
  double sin = 0.0;
  double cos = 1.0;
  values[0] = 1.0;
  for (std::size_t i = 1; i < values.size(); i += 2) {
    const double next = sin * c + cos * s;
    cos = cos * c - sin * s;
    sin = next;
    values[i] = sin;
    values[i + 1] = cos;
  }
}

void TrigonometricMoments::reset(int highest) {
  cos_.assign(static_cast<std::size_t>(highest) + 1, 0.0);
  sin_.assign(static_cast<std::size_t>(highest) + 1, 0.0);
}

void TrigonometricMoments::set_piece(double begin, double length) {
  const double half = 0.5 * length;
  const double s = std::sin(begin + half);
  const double c = std::cos(begin + half);
  const double half_s = std::sin(half);
  const double half_c = std::cos(half);
  double sin = 0.0;
  double cos = 1.0;
  double width_sin = 0.0;
  double width_cos = 1.0;
  cos_[0] = length;
  sin_[0] = 0.0;
  for (std::size_t m = 1; m < cos_.size(); ++m) {
    const double next = sin * c + cos * s;
    cos = cos * c - sin * s;
    sin = next;
    const double next_width = width_sin * half_c + width_cos * half_s;
    width_cos = width_cos * half_c - width_sin * half_s;
    width_sin = next_width;
    const double width = 2.0 * width_sin / static_cast<double>(m);
    cos_[m] = cos * width;
    sin_[m] = sin * width;
  }
}

void TrigonometricMoments::set_period() {
  std::fill(cos_.begin(), cos_.end(), 0.0);
  std::fill(sin_.begin(), sin_.end(), 0.0);
  cos_[0] = 2.0 * std::numbers::pi;
}

void TrigonometricMoments::add(double factor, const TrigonometricMoments& other) {
  for (std::size_t m = 0; m < cos_.size(); ++m) {
    cos_[m] += factor * other.cos_[m];
    sin_[m] += factor * other.sin_[m];
  }
}

void TrigonometricMoments::set_sums(const double* sums) {
  cos_[0] = sums[0];
  for (std::size_t m = 1; m < cos_.size(); ++m) {
    sin_[m] = sums[2 * m - 1];
    cos_[m] = sums[2 * m];
  }
}

double TrigonometricMoments::product(int i, int j) const {
  const auto a = static_cast<int>(index(i));
  const auto b = static_cast<int>(index(j));
  const bool i_sine = i % 2 == 1;
  const bool j_sine = j % 2 == 1;
  const std::size_t sum = index(i) + index(j);
  const auto difference = static_cast<std::size_t>(std::abs(a - b));
  if (i_sine == j_sine) {
    return 0.5 * (i_sine ? cos_[difference] - cos_[sum] : cos_[difference] + cos_[sum]);
  }
  const bool sine_is_higher = i_sine ? a >= b : b >= a;
  return 0.5 * (sine_is_higher ? sin_[sum] + sin_[difference] : sin_[sum] - sin_[difference]);
}

}  // namespace microslip::contact
