#include "contact/force/block_kernels.hpp"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <random>
#include <vector>

namespace microslip::contact::test_block_kernels {
namespace {

constexpr std::size_t n_modes = 5;
constexpr std::size_t n_points = 24;

std::vector<double> random_rows(std::size_t n_rows, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::vector<double> rows(n_rows * block_points);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    // What lies beyond the points of the block must not be read.
    rows[i] =
        i % block_points < n_points ? uniform(random) : std::numeric_limits<double>::quiet_NaN();
  }
  return rows;
}

// Sums of 24 products of order one, in another order or fused: 24 roundings.
constexpr double rounding = 5e-15;

class BlockKernelSets : public testing::TestWithParam<const BlockKernels*> {};

TEST_P(BlockKernelSets, ForceIsTheSumOverPoints) {
  const std::vector<double> phi = random_rows(n_modes, 2);
  const std::vector<double> force = random_rows(3, 3);
  std::vector<double> sum(3 * n_modes, 1.0);
  GetParam()->add_force(n_modes, n_points, phi.data(), force.data(), sum.data());
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t mode = 0; mode < n_modes; ++mode) {
      double expected = 1.0;
      for (std::size_t point = 0; point < n_points; ++point) {
        expected += phi[mode * block_points + point] * force[r * block_points + point];
      }
      EXPECT_NEAR(sum[r * n_modes + mode], expected, rounding);
    }
  }
}

double product_sum(const std::vector<double>& phi, std::size_t i, const std::vector<double>& psi,
                   std::size_t j, const std::vector<double>& a, std::size_t e) {
  double sum = 0.0;
  for (std::size_t point = 0; point < n_points; ++point) {
    sum +=
        phi[i * block_points + point] * psi[j * block_points + point] * a[e * block_points + point];
  }
  return sum;
}

TEST_P(BlockKernelSets, ProductsAreSumsOverPointsForEachPairOfModes) {
  const std::vector<double> phi = random_rows(n_modes, 4);
  const std::vector<double> psi = random_rows(n_modes, 5);
  const std::vector<double> a = random_rows(9, 6);
  std::vector<double> nine(9 * n_modes * n_modes, 0.0);
  std::vector<double> seven(7 * n_modes * n_modes, 0.0);
  std::vector<double> six(6 * n_modes * n_modes, 0.0);
  GetParam()->add_products_9(n_modes, n_points, phi.data(), psi.data(), a.data(), nine.data());
  GetParam()->add_symmetric_products_7(n_modes, n_points, phi.data(), a.data(), seven.data());
  GetParam()->add_symmetric_products_6(n_modes, n_points, phi.data(), a.data(), six.data());
  for (std::size_t i = 0; i < n_modes; ++i) {
    for (std::size_t j = 0; j < n_modes; ++j) {
      const std::size_t pair = i * n_modes + j;
      for (std::size_t e = 0; e < 9; ++e) {
        EXPECT_NEAR(nine[9 * pair + e], product_sum(phi, i, psi, j, a, e), rounding);
      }
      for (std::size_t e = 0; e < 7 && j <= i; ++e) {
        EXPECT_NEAR(seven[7 * pair + e], product_sum(phi, i, phi, j, a, e), rounding);
      }
      for (std::size_t e = 0; e < 6 && j <= i; ++e) {
        EXPECT_NEAR(six[6 * pair + e], product_sum(phi, i, phi, j, a, e), rounding);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Sets, BlockKernelSets, testing::ValuesIn(runnable_block_kernels()));

}  // namespace
}  // namespace microslip::contact::test_block_kernels
