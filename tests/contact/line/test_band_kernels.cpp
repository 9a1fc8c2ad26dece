/// Kernels of every instruction set against sums term by term.
#include "contact/line/band_kernels.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <vector>

namespace microslip::contact::test_band_kernels {
namespace {

constexpr int H = 5;
constexpr double rounding = 1e-13;  // of some ten terms of up to H² of order one

/// Numbers of order one without a pattern.
std::vector<double> numbers(std::size_t n, double seed) {
  std::vector<double> values(n);
  for (std::size_t i = 0; i < n; ++i)
    values[i] = std::sin(seed + 7.3 * static_cast<double>(i * i + 1));
  return values;
}

BandValues arcs() {
  BandValues x{};
  for (std::size_t i = 0; i < x.size(); ++i)
    x[i] = longest_band_arc * (static_cast<double>(2 * i) / (n_band_nodes - 1) - 1.0);
  return x;
}

double waves(const std::vector<double>& y, double phase, int derivative) {
  double sum = derivative == 0 ? y[0] : 0.0;
  for (int h = 1; h <= H; ++h) {
    const auto k = static_cast<std::size_t>(2 * h);
    const double turn = 0.5 * std::acos(-1.0) * derivative;
    sum += std::pow(h, derivative) *
           (y[k - 1] * std::sin(h * phase + turn) + y[k] * std::cos(h * phase + turn));
  }
  return sum;
}

TEST(BandKernels, MotionIsThatOfItsWaves) {
  const std::vector<double> u = numbers(2 * H + 1, 1.0);
  const std::vector<double> v = numbers(2 * H + 1, 2.0);
  const BandValues x = arcs();
  const double middle = 2.5;
  for (const BandKernels* kernels : runnable_band_kernels()) {
    std::vector<double> basis((4 * H + 1) * n_band_nodes);
    BandMotion now;
    kernels->motion({u.data(), v.data(), H}, {std::sin(middle), std::cos(middle)}, x.data(), 2 * H,
                    basis.data(), now);
    for (std::size_t i = 0; i < n_band_nodes; ++i) {
      const double phase = middle + x[i];
      EXPECT_NEAR(now.position[i], waves(u, phase, 0) - u[0], rounding);
      EXPECT_NEAR(now.velocity[i], waves(u, phase, 1), rounding);
      EXPECT_NEAR(now.acceleration[i], waves(u, phase, 2), rounding);
      EXPECT_NEAR(now.approach[i], waves(v, phase, 0), rounding);
      EXPECT_NEAR(now.approach_rate[i], waves(v, phase, 1), rounding);
      EXPECT_EQ(basis[i], 1.0);
      for (int h = 1; h <= 2 * H; ++h) {
        const auto row = static_cast<std::size_t>((2 * h - 1) * n_band_nodes) + i;
        EXPECT_NEAR(basis[row], std::sin(h * phase), rounding);
        EXPECT_NEAR(basis[row + n_band_nodes], std::cos(h * phase), rounding);
      }
    }
  }
}

// Where u' vanishes, offsets keep the digits that phases lose.
TEST(BandKernels, LayersKeepTheDigitsOfTheirOffsets) {
  const std::vector<double> rate{0.0, -std::sin(1.0), std::cos(1.0)};  // u' = cos(θ + 1)
  const double anchor = 0.5 * std::acos(-1.0) - 1.0;
  BandValues x{};
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = std::pow(10.0, -static_cast<double>(i));
  for (const BandKernels* kernels : runnable_band_kernels()) {
    BandValues velocity{};
    kernels->layer(rate.data(), 1, {std::sin(anchor), std::cos(anchor)}, 0.0, x.data(),
                   velocity.data());
    for (std::size_t i = 0; i < x.size(); ++i)
      EXPECT_NEAR(velocity[i] / -std::sin(x[i]), 1.0, 1e-14) << x[i];
  }
}

TEST(BandKernels, SumsAreAddedWhereTheyBelong) {
  constexpr int n = 7;
  constexpr int stride = 8;
  const std::vector<double> basis = numbers(n * n_band_nodes, 3.0);
  const std::vector<double> weights = numbers(stride * n_band_nodes, 4.0);
  for (const BandKernels* kernels : runnable_band_kernels()) {
    for (const int m : {1, 2}) {
      std::vector<double> sums(n * stride, 1.0);
      kernels->sums(n, m, basis.data(), weights.data(), stride, sums.data());
      for (std::size_t k = 0; k < n; ++k) {
        for (std::size_t j = 0; j < stride; ++j) {
          double sum = 1.0;
          for (std::size_t i = 0; i < n_band_nodes && j < static_cast<std::size_t>(4 * m); ++i)
            sum += basis[k * n_band_nodes + i] * weights[j * n_band_nodes + i];
          EXPECT_NEAR(sums[k * stride + j], sum, rounding) << k << ' ' << j;
        }
      }
    }
  }
}

}  // namespace
}  // namespace microslip::contact::test_band_kernels
