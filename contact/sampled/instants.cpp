#include "contact/sampled/instants.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

namespace microslip::contact::sampled {

Instants::Instants(int n, int n_harmonics)
    : n_(static_cast<std::size_t>(n)),
      n_harmonics_(n_harmonics),
      n_rows_(2 * static_cast<std::size_t>(n_harmonics) + 1) {
  if (n < 2 * (2 * n_harmonics + 1)) {
    throw std::invalid_argument("sampled::Instants: " + std::to_string(n) + " instants for " +
                                std::to_string(n_harmonics) + " harmonics");
  }
  const auto H = static_cast<std::size_t>(n_harmonics);
  basis_.resize(n_ * n_rows_);
  rates_.resize(n_ * n_rows_);
  moment_basis_.resize(n_ * n_moments());
  sums_.assign((n_ + 1) * n_moments(), 0.0);
  for (std::size_t i = 0; i < n_; ++i) {
    double* moment = moment_basis_.data() + i * n_moments();
    for (std::size_t m = 0; m <= 2 * H; ++m) {
      // The remainder keeps the argument within a period: tables are as exact for high harmonics.
      const double phase = 2.0 * std::numbers::pi * static_cast<double>(m * i % n_) / n;
      moment[m] = std::cos(phase);
      if (m > 0) moment[2 * H + m] = std::sin(phase);
    }
    double* T = basis_.data() + i * n_rows_;
    double* rate = rates_.data() + i * n_rows_;
    T[0] = 1.0;
    rate[0] = 0.0;
    for (std::size_t h = 1; h <= H; ++h) {
      T[h] = moment[2 * H + h];
      T[H + h] = moment[h];
      rate[h] = static_cast<double>(h) * T[H + h];
      rate[H + h] = -static_cast<double>(h) * T[h];
    }
    for (std::size_t m = 0; m < n_moments(); ++m) {
      sums_[(i + 1) * n_moments() + m] = sums_[i * n_moments() + m] + moment[m];
    }
  }
}

void Products::reset(int n_harmonics) {
  n_harmonics_ = static_cast<std::size_t>(n_harmonics);
  cos_.assign(4 * n_harmonics_ + 1, 0.0);
  sin_.assign(4 * n_harmonics_ + 1, 0.0);
}

void Products::set(const double* moments) {
  const std::size_t last = 2 * n_harmonics_;
  cos_[last] = moments[0];
  sin_[last] = 0.0;
  for (std::size_t m = 1; m <= last; ++m) {
    cos_[last + m] = cos_[last - m] = moments[m];
    sin_[last + m] = moments[last + m];
    sin_[last - m] = -moments[last + m];
  }
}

void Products::row(std::size_t k, double* result) const {
  const std::size_t H = n_harmonics_;
  const double* C = cos_.data() + 2 * H;
  const double* S = sin_.data() + 2 * H;
  double* sine = result + 1;
  double* cosine = result + 1 + H;
  if (k == 0) {
    result[0] = C[0];
    for (std::size_t b = 1; b <= H; ++b) sine[b - 1] = S[b];
    for (std::size_t b = 1; b <= H; ++b) cosine[b - 1] = C[b];
    return;
  }
  const bool is_sine = k <= H;
  const auto a = static_cast<std::ptrdiff_t>(is_sine ? k : k - H);
  const auto n = static_cast<std::ptrdiff_t>(H);
  if (is_sine) {
    result[0] = S[a];
    for (std::ptrdiff_t b = 1; b <= n; ++b) sine[b - 1] = 0.5 * (C[b - a] - C[a + b]);
    for (std::ptrdiff_t b = 1; b <= n; ++b) cosine[b - 1] = 0.5 * (S[a + b] - S[b - a]);
  } else {
    result[0] = C[a];
    for (std::ptrdiff_t b = 1; b <= n; ++b) sine[b - 1] = 0.5 * (S[a + b] + S[b - a]);
    for (std::ptrdiff_t b = 1; b <= n; ++b) cosine[b - 1] = 0.5 * (C[b - a] + C[a + b]);
  }
}

}  // namespace microslip::contact::sampled
